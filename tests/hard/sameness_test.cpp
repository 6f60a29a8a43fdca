#include "checks_mpi.hpp"
#include "floating_point.hpp"
#include "hard_clouds.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>

namespace rrcb::hard_test {
namespace {

struct Arithmetic {
    const char* name;
    void (*set)(FloatingPoint&);
};

constexpr std::array unusual = {
    Arithmetic{"upward", [](FloatingPoint& here) { here.round(FE_UPWARD); }},
    Arithmetic{"downward", [](FloatingPoint& here) { here.round(FE_DOWNWARD); }},
    Arithmetic{"toward zero", [](FloatingPoint& here) { here.round(FE_TOWARDZERO); }},
    Arithmetic{"without subnormals", [](FloatingPoint& here) { here.flush_subnormals(); }},
};

Options one_part_per_rank() {
    Options options{.num_parts = parts_for(num_ranks()), .imbalance_tolerance = asked_tolerance};
    return options;
}

bool same_bits(std::span<const double> a, std::span<const double> b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

void expect_same(const Balance& a, const Balance& b) {
    EXPECT_TRUE(same_bits(numbers_of(a.cuts), numbers_of(b.cuts)));
    EXPECT_EQ(a.parts, b.parts);
    const std::array of_a{a.report.details.estimated_imbalance, a.report.imbalance};
    const std::array of_b{b.report.details.estimated_imbalance, b.report.imbalance};
    EXPECT_TRUE(same_bits(of_a, of_b));
    EXPECT_EQ(a.report.details.rounds, b.report.details.rounds);
}

TEST_P(HardCloud, gives_the_same_bits_twice) {
    const Share share = scattered_share(cloud());
    MPI_Comm other = MPI_COMM_NULL;
    MPI_Comm_dup(MPI_COMM_WORLD, &other);
    for (const Method& method : methods) {
        SCOPED_TRACE(std::string(method.domain_name) + " " + method.refine_name);
        const Options options = one_part_per_rank();
        expect_same(balance(share.points(), method, options, MPI_COMM_WORLD),
                    balance(share.points(), method, options, other));
    }
    MPI_Comm_free(&other);
}

std::vector<double> of_all_ranks(const std::vector<double>& mine) {
    const auto size = static_cast<std::size_t>(num_ranks());
    std::vector<int> counts(size);
    std::vector<int> starts(size);
    const auto count = static_cast<int>(mine.size());
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
    std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
    std::vector<double> all(static_cast<std::size_t>(starts.back() + counts.back()));
    MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), starts.data(),
                   MPI_DOUBLE, MPI_COMM_WORLD);
    return all;
}

/// All points at the root are the points of one rank, by rank, whatever the number of ranks.
TEST_P(HardCloud, gives_the_cuts_of_one_rank_where_all_points_go_to_the_root) {
    const Share mine = scattered_share(cloud());
    Share all = mine;
    all.coordinates = of_all_ranks(mine.coordinates);
    all.weights = of_all_ranks(mine.weights);
    PaperOptions options{.num_parts = parts_for(num_ranks()), .domain = PaperDomain::points};
    const Balance result = balance_as_in_paper(mine.points(), MPI_COMM_WORLD, options);
    const Balance alone = balance_as_in_paper(all.points(), MPI_COMM_SELF, options);
    EXPECT_TRUE(same_bits(numbers_of(result.cuts), numbers_of(alone.cuts)));
    EXPECT_EQ(result.report.details.num_points, alone.report.details.num_points);
}

INSTANTIATE_TEST_SUITE_P(Positions, HardCloud,
                         testing::ValuesIn(names_of(clouds_hard_by_position())), name_of);
INSTANTIATE_TEST_SUITE_P(Weights, HardCloud, testing::ValuesIn(names_of(clouds_hard_by_weight())),
                         name_of);

/// All ranks round alike: the cuts are the same everywhere and as good as any.
TEST(Sameness, of_any_arithmetic_is_enough) {
    for (const char* name : {"lattice", "many_in_few_places", "two_far_clusters", "whole_range"}) {
        const Cloud& cloud = find_cloud(name);
        const Share share = scattered_share(cloud);
        for (const Arithmetic& arithmetic : unusual) {
            for (const Method& method : methods) {
                SCOPED_TRACE(std::string(name) + ", " + arithmetic.name);
                const Options options = one_part_per_rank();
                Balance result;
                {
                    FloatingPoint here;
                    arithmetic.set(here);
                    result = balance(share.points(), method, options, MPI_COMM_WORLD);
                }
                const std::vector<double> numbers = numbers_of(result.cuts);
                expect_same_on_all_ranks(std::as_bytes(std::span(numbers)));
                const auto all = join_parts(share, result.parts, cloud.count(options.num_parts),
                                            options.num_parts);
                if (method.balances())
                    expect_balanced(cloud, all, options.num_parts, method.tolerance());
            }
        }
    }
}

/// One rank rounds differently: nobody gets cuts that others would not agree with.
TEST(Sameness, of_the_arithmetic_is_asked_for) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const Share share = scattered_share(find_cloud("lattice"));
    for (const Arithmetic& arithmetic : unusual) {
        for (const Method& method : methods) {
            SCOPED_TRACE(arithmetic.name);
            std::string text;
            try {
                FloatingPoint here;
                if (is_last_rank()) arithmetic.set(here);
                balance(share.points(), method, one_part_per_rank(), MPI_COMM_WORLD);
            } catch (const Error& error) {
                text = error.what();
            }
            EXPECT_NE(text.find("rounding, subnormal numbers) differs"), text.npos) << text;
            EXPECT_EQ(balance(share.points(), method, one_part_per_rank(), MPI_COMM_WORLD)
                          .report.details.num_points,
                      512);
        }
    }
}

}  // namespace
}  // namespace rrcb::hard_test
