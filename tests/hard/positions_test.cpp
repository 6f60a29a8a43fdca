#include "checks_mpi.hpp"
#include "hard_clouds.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/quality.hpp>

#include <cmath>

namespace rrcb::hard_test {
namespace {

INSTANTIATE_TEST_SUITE_P(Positions, HardCloud,
                         testing::ValuesIn(names_of(clouds_hard_by_position())), name_of);

TEST(Positions, that_coincide_are_told_in_the_report) {
    Options options{.num_parts = 4};
    for (const Refine refine : {Refine::tolerance, Refine::exact}) {
        options.refine = refine;
        const Share one_place = scattered_share(find_cloud("coincident"));
        const Report report = balance(one_place.points(), MPI_COMM_WORLD, options).report;
        EXPECT_EQ(report.imbalance, 4);
        EXPECT_EQ(report.details.coincident_cuts,
                  2);  // of all points, and of the half that holds them
        const Share lattice = scattered_share(find_cloud("lattice"));
        EXPECT_EQ(balance(lattice.points(), MPI_COMM_WORLD, options).report.details.coincident_cuts,
                  0);
    }
}

TEST(Positions, that_moments_cannot_tell_are_measured_and_refined) {
    // An uneven pair of clumps looks like a density that falls from one side to the other.
    Cloud cloud = find_cloud("coincident");
    cloud.position = [](int i) {
        const double where = uniform(i, 0);
        const double clump = where < 0.7 ? 0.28 : 0.88;
        return Vector{where < 0.9 ? clump + 0.04 * uniform(i, 1) : uniform(i, 1),
                      0.01 * uniform(i, 2)};
    };
    const Share share = scattered_share(cloud);
    Options options{.num_parts = 4, .refine = Refine::none, .expert = {.cells_per_axis = 1}};
    const Balance blind = balance(share.points(), MPI_COMM_WORLD, options);
    const auto weights = part_weights(share.points(), blind.parts, 4, MPI_COMM_WORLD);
    EXPECT_NEAR(blind.report.details.estimated_imbalance, 1, 1e-9);
    EXPECT_TRUE(std::isnan(blind.report.imbalance));
    EXPECT_GT(imbalance(weights), 1.1);

    options.refine = Refine::tolerance;
    options.imbalance_tolerance = asked_tolerance;
    const Report report = balance(share.points(), MPI_COMM_WORLD, options).report;
    EXPECT_NEAR(report.details.estimated_imbalance, 1, 1e-9);
    EXPECT_LE(report.imbalance, asked_tolerance);
    EXPECT_GT(report.details.rounds, 1);
}

TEST(Positions, of_equal_extents_stay_in_their_parts_from_call_to_call) {
    // Three parts of the L: its second cut into four would find extents of 9.1 and 9.9, which lie
    // next to the tenth up to which they count as equal.
    for (const auto& [name, num_parts] : {std::pair{"far_from_the_origin", 4},
                                          {"hollow_shell", 4},
                                          {"cantor_dust", 4},
                                          {"l_shaped", 3}}) {
        Options options{.num_parts = num_parts};
        const Cloud& cloud = find_cloud(name);
        const Share share = scattered_share(cloud);
        const Balance first = balance(share.points(), MPI_COMM_WORLD, options);
        const auto parts = join_parts(share, first.parts, 600, num_parts);
        const Share settled = migrated(cloud, parts, num_parts);
        const Balance second = balance(settled.points(), MPI_COMM_WORLD, options);
        EXPECT_LE(count_moves(settled, second.parts, parts), 30) << name << " of 600";
    }
}

TEST(Positions, outside_every_earlier_box_are_divided_from_earlier_cuts) {
    const Share earlier = scattered_share(find_cloud("spiral"));
    Options options{.num_parts = parts_for(num_ranks())};
    const Cuts cuts = balance(earlier.points(), MPI_COMM_WORLD, options).cuts;
    for (const double distance : {-1e7, 3e3, 1e150}) {
        Share later = earlier;
        for (double& x : later.coordinates) x = distance + std::abs(distance) * 1e-3 * x;
        for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact}) {
            options.refine = refine;
            const Balance result = balance(later.points(), MPI_COMM_WORLD, options, cuts);
            for (LocalIndex i = 0; i < result.parts.size(); ++i)
                ASSERT_EQ(result.parts[i], part_of(result.cuts, later.points().position(i)));
            const auto weights =
                part_weights(later.points(), result.parts, options.num_parts, MPI_COMM_WORLD);
            if (refine == Refine::none) continue;
            EXPECT_EQ(result.report.imbalance, imbalance(weights));
            EXPECT_LE(imbalance(weights), 1.01 + options.num_parts / 600.0);
        }
    }
}

}  // namespace
}  // namespace rrcb::hard_test
