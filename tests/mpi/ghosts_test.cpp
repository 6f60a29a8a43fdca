#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/distance.hpp"
#include "../support/ranks.hpp"
#include "slabs.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/experimental/verify.hpp>
#include <rrcb/ghosts.hpp>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A cloud of which every rank knows all points.
struct Cloud {
    int dimension;
    std::vector<double> coordinates;

    std::size_t count() const { return coordinates.size() / static_cast<std::size_t>(dimension); }
    Points points() const { return Points(coordinates, dimension); }
    Vector position(std::size_t i) const { return points().position(i); }
};

Cloud random_cloud(std::size_t count, int dimension) {
    return {dimension, test::uniform_cloud(count, dimension, 3)};
}

/// Whole coordinates: many points share them, lie on cuts, and are exactly 1, sqrt(2), 5 apart.
Cloud lattice_cloud(int dimension) {
    Cloud cloud{dimension, {}};
    const int width = dimension == 2 ? 24 : 9;
    for (int x = 0; x < width; ++x)
        for (int y = 0; y < width; ++y)
            for (int z = 0; z < (dimension == 3 ? width : 1); ++z)
                for (const int coordinate : std::vector{x, y, z})
                    cloud.coordinates.push_back(coordinate);
    if (dimension == 2) {
        Cloud flat{2, {}};
        for (std::size_t i = 0; i < cloud.coordinates.size(); ++i)
            if (i % 3 != 2) flat.coordinates.push_back(cloud.coordinates[i]);
        return flat;
    }
    return cloud;
}

/// The points of a cloud on the ranks of their parts, by number.
struct Division {
    Cloud cloud;
    Cuts cuts;
    std::vector<RankRange> ranks_of_parts;
    std::vector<int> owners;            ///< of all points
    std::vector<std::int64_t> numbers;  ///< of the points here
    std::vector<double> here;           ///< their coordinates

    Points points() const { return Points(here, cloud.dimension); }
};

/// Balances into parts that lie on ranks_of_part, or turned by `turn` ranks.
Division divide(const Cloud& cloud, int num_parts, int turn = 0) {
    Division division{cloud, {}, {}, {}, {}, {}};
    std::vector<double> mine;
    std::vector<std::int64_t> numbers;
    const auto d = static_cast<std::ptrdiff_t>(cloud.dimension);
    for (std::size_t i = 0; i < cloud.count(); ++i) {
        if (static_cast<int>(i) % num_ranks() != rank()) continue;
        numbers.push_back(static_cast<std::int64_t>(i));
        const auto begin = cloud.coordinates.begin() + static_cast<std::ptrdiff_t>(i) * d;
        mine.insert(mine.end(), begin, begin + d);
    }
    Options options{.num_parts = num_parts, .refine = Refine::exact};
    const Balance balance = rrcb::balance(Points(mine, cloud.dimension), MPI_COMM_WORLD, options);
    division.cuts = balance.cuts;
    std::vector<Part> destinations = balance.parts;
    for (Part part = 0; part < num_parts; ++part) {
        RankRange ranks = ranks_of_part(part, num_parts, num_ranks());
        if (turn > 0) ranks = {(ranks.first_rank + turn) % num_ranks(), 1};
        division.ranks_of_parts.push_back(ranks);
    }
    if (turn > 0)
        for (Part& part : destinations)
            part = division.ranks_of_parts[static_cast<std::size_t>(part)].first_rank;
    const Plan lists = plan(destinations, turn > 0 ? num_ranks() : num_parts, MPI_COMM_WORLD);
    std::tie(division.numbers, division.here) = transfer(
        lists, columns(numbers, column(mine, static_cast<std::size_t>(d))), MPI_COMM_WORLD);
    division.owners.assign(cloud.count(), -1);
    for (const std::int64_t number : division.numbers)
        division.owners[static_cast<std::size_t>(number)] = rank();
    MPI_Allreduce(MPI_IN_PLACE, division.owners.data(), static_cast<int>(cloud.count()), MPI_INT,
                  MPI_MAX, MPI_COMM_WORLD);
    return division;
}

/// Distance of a point to the nearest region of this rank.
long double distance_to_mine(const Division& division, const Vector& x) {
    long double least = infinity;
    for (Part part = 0; part < division.cuts.num_parts; ++part) {
        const RankRange& ranks = division.ranks_of_parts[static_cast<std::size_t>(part)];
        if (rank() >= ranks.first_rank && rank() < ranks.first_rank + ranks.count)
            least = std::min(
                least, test::distance(x, box_of(division.cuts, part), division.cloud.dimension));
    }
    return least;
}

/// Compares the ghosts with the regions, and with all pairs of near points; gives how many pairs.
GlobalCount expect_ghosts(const Division& division, double radius, const GhostPlan& lists) {
    const Cloud& cloud = division.cloud;
    const std::vector<std::int64_t> got = fetch(lists, division.numbers, MPI_COMM_WORLD);
    std::vector<char> is_ghost(cloud.count(), 0);
    for (const std::int64_t number : got) ++is_ghost[static_cast<std::size_t>(number)];
    for (std::size_t j = 0; j < cloud.count(); ++j) {
        const Vector x = cloud.position(j);
        const bool is_mine = division.owners[j] == rank();
        const long double apart = distance_to_mine(division, x);
        if (is_mine || apart > radius * (1 + 4e-15L)) {
            EXPECT_EQ(is_ghost[j], 0);
        } else if (apart <= radius) {
            EXPECT_EQ(is_ghost[j], 1);
        }
    }
    const experimental::VerifyOptions everything{.sample = std::numeric_limits<std::size_t>::max()};
    const experimental::Verification seen =
        experimental::verify(lists, division.points(), MPI_COMM_WORLD, everything);
    EXPECT_EQ(seen.num_faults, 0);
    return seen.num_pairs;
}

TEST(Ghosts, miss_none_of_a_million_pairs) {
    GlobalCount num_pairs = 0;
    for (const int dimension : {2, 3}) {
        for (const Cloud& cloud : {random_cloud(600, dimension), lattice_cloud(dimension)}) {
            const Division division = divide(cloud, num_ranks());
            for (const double radius : {0.0, 0.03, 0.2, 1.0, std::sqrt(2.0), 5.0, 100.0})
                num_pairs += expect_ghosts(division, radius,
                                           ghost_plan(division.cuts, division.points(),
                                                      MPI_COMM_WORLD, {.cutoff = radius}));
        }
    }
    if (num_ranks() == 1) return;
    EXPECT_GT(num_pairs, 1'000'000);
}

TEST(Ghosts, follow_parts_to_the_ranks_that_have_them) {
    const Division division = divide(lattice_cloud(2), 2 * num_ranks(), 1);
    for (const double radius : {0.0, 1.0, 2.5})
        expect_ghosts(division, radius,
                      ghost_plan(division.cuts, division.points(), MPI_COMM_WORLD,
                                 {.cutoff = radius, .ranks_of_parts = division.ranks_of_parts}));
}

TEST(Ghosts, come_from_neighbours_alone_in_one_message_each) {
    const std::vector<double> coordinates{rank() + 0.1, 0, rank() + 0.5, 0, rank() + 0.9, 0};
    const Points points(coordinates, 2);
    const GhostPlan lists = ghost_plan(test::slabs(), points, MPI_COMM_WORLD, {.cutoff = 0.2});
    std::vector<std::pair<int, LocalIndex>> expected;
    if (rank() > 0) expected.emplace_back(rank() - 1, 0);
    if (!is_last_rank()) expected.emplace_back(rank() + 1, 2);
    ASSERT_EQ(lists.send.size(), expected.size());
    ASSERT_EQ(lists.receive.size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_EQ(lists.send[k].rank, expected[k].first);
        EXPECT_EQ(lists.send[k].count, 1u);
        EXPECT_EQ(lists.send_indices[k], expected[k].second);
        EXPECT_EQ(lists.receive[k].rank, expected[k].first);
        EXPECT_EQ(lists.receive[k].count, 1u);
    }
    const std::vector<int> colours{10 * rank(), 10 * rank() + 1, 10 * rank() + 2};
    TransferReport report;
    const auto [colour, x] = fetch(lists, columns(colours, column(coordinates, 2)), MPI_COMM_WORLD,
                                   {.max_bytes = 100, .report = &report});
    EXPECT_EQ(report.num_messages, expected.size());
    EXPECT_LE(report.peak_bytes, 100u);
    ASSERT_EQ(x.size(), 2 * expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
        const int from = expected[k].first;
        EXPECT_EQ(colour[k], 10 * from + (from < rank() ? 2 : 0));
        EXPECT_EQ(x[2 * k], from + (from < rank() ? 0.9 : 0.1));
    }
}

TEST(Ghosts, at_exactly_the_radius_count) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    // 0.25 from the cut, and the next number beyond what rounding may lose.
    const std::vector<double> coordinates{rank() + 0.75, 0, rank() + 0.75 - 0x1p-40, 0};
    const GhostPlan lists =
        ghost_plan(test::slabs(), Points(coordinates, 2), MPI_COMM_WORLD, {.cutoff = 0.25});
    EXPECT_EQ(lists.send_indices,
              is_last_rank() ? std::vector<LocalIndex>{} : std::vector<LocalIndex>{0});
}

TEST(Ghosts, go_to_no_rank_whose_part_is_empty) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    // The last cut is below the one above it: no position is between them.
    Cuts cuts = test::slabs();
    cuts.tree.back().at[0] = num_ranks() == 2 ? -std::numeric_limits<double>::infinity() : -1;
    const Part empty = num_ranks() == 2 ? 0 : num_ranks() - 2;
    const std::vector<double> coordinates{num_ranks() - 2.0, 0, 0.25, 0, num_ranks() - 0.5, 0};
    const GhostPlan lists =
        ghost_plan(cuts, Points(coordinates, 2), MPI_COMM_WORLD, {.cutoff = 100});
    for (const RankCount& share : lists.send) EXPECT_NE(share.rank, empty);
    EXPECT_EQ(lists.send.size(), static_cast<std::size_t>(num_ranks() - (rank() == empty ? 1 : 2)));
    EXPECT_EQ(lists.receive.empty(), rank() == empty);
}

}  // namespace
}  // namespace rrcb
