#include "../support/same_error.hpp"
#include "paper_shares.hpp"

#include <rrcb/error.hpp>
#include <rrcb/paper.hpp>

namespace rrcb {
namespace {

using test::crowded_share;
using test::Share;
using test::weighted_share;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Expects the same error, which contains `expected`, on every rank, and that the next call works.
void expect_error(const Share& share, const PaperOptions& options, const std::string& expected) {
    test::expect_same_error([&] { balance_as_in_paper(share.points(), MPI_COMM_WORLD, options); },
                            expected);
    const Share fine = crowded_share(rank());
    EXPECT_EQ(balance_as_in_paper(fine.points(), MPI_COMM_WORLD).parts.size(), 300u);
}

std::string last_rank() {
    return "rank " + std::to_string(num_ranks() - 1) + ": ";
}

TEST(PaperErrors, of_points_of_one_rank_reach_all) {
    for (const PaperDomain domain : {PaperDomain::sampled, PaperDomain::points}) {
        PaperOptions options{.domain = domain};
        Share broken = crowded_share(rank());
        if (is_last_rank()) broken.coordinates[3] = nan;
        expect_error(broken, options, last_rank() + "coordinate of point 1 on axis 1");
        broken = crowded_share(rank());
        broken.weights.assign(300, 1.0);
        if (is_last_rank()) broken.weights[2] = -1;
        expect_error(broken, options, last_rank() + "weight of point 2 is negative");
        if (num_ranks() == 1) continue;
        broken.weights.assign(300, 5e305);
        expect_error(broken, options, "the sum of the weights of all ranks overflows");
    }
}

TEST(PaperErrors, of_options_name_the_range) {
    const Share mine = crowded_share(rank());
    const auto with = [&](auto change, const std::string& expected) {
        PaperOptions options;
        change(options);
        expect_error(mine, options, "rank 0: " + expected);
    };
    with([](PaperOptions& o) { o.num_parts = -1; }, "num_parts must be positive");
    for (const int mesh : {0, 4097})
        with([&](PaperOptions& o) { o.cells_per_axis = mesh; },
             "cells_per_axis must be 1 ... 4096");
    for (const double k : {0.0, nan, HUGE_VAL})
        with([&](PaperOptions& o) { o.sigma_multiplier = k; },
             "sigma_multiplier must be finite and above 0");
    for (const double fraction : {0.0, 1.5, nan})
        with([&](PaperOptions& o) { o.sample_fraction = fraction; },
             "sample_fraction must be in (0, 1]");
    with([](PaperOptions& o) { o.domain = static_cast<PaperDomain>(7); }, "domain must be");
    with([](PaperOptions& o) { o.cut_rule = static_cast<CutRule>(-1); }, "cut_rule must be");
    with([](PaperOptions& o) { o.num_parts = 2, o.part_sizes = {1}; }, "part_sizes must hold one");
    with([](PaperOptions& o) { o.num_parts = 2, o.part_sizes = {0, 0}; }, "part_sizes must have a");
}

TEST(PaperErrors, of_a_mesh_in_space_begin_at_257_cells) {
    PaperOptions options{.cells_per_axis = 257};
    expect_error(weighted_share(rank()), options, "in 3-D 1 ... 256");
}

TEST(PaperErrors, of_options_that_differ_name_the_option_and_the_rank) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const Share mine = crowded_share(rank());
    const auto with = [&](auto change, const std::string& name) {
        PaperOptions options;
        if (is_last_rank()) change(options);
        expect_error(mine, options,
                     name + " differs between rank 0 and rank " + std::to_string(num_ranks() - 1));
    };
    with([](PaperOptions& o) { o.num_parts = 99; }, "num_parts");
    with([](PaperOptions& o) { o.part_sizes.assign(static_cast<std::size_t>(num_ranks()), 1); },
         "part_sizes");
    with([](PaperOptions& o) { o.domain = PaperDomain::points; }, "domain");
    with([](PaperOptions& o) { o.cut_rule = CutRule::midpoint; }, "cut_rule");
    with([](PaperOptions& o) { o.plain_cuts = true; }, "plain_cuts");
    with([](PaperOptions& o) { o.cells_per_axis = 3; }, "cells_per_axis");
    with([](PaperOptions& o) { o.sigma_multiplier = 3; }, "sigma_multiplier");
    with([](PaperOptions& o) { o.sample_fraction = 0.5; }, "sample_fraction");
    with([](PaperOptions& o) { o.seed = 3; }, "seed");
    Share other = mine;
    if (is_last_rank()) other.dimension = 3;
    expect_error(other, {}, "dimension differs between rank 0");
}

}  // namespace
}  // namespace rrcb
