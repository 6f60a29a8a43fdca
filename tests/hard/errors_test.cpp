#include "../support/ranks.hpp"
#include "../support/same_error.hpp"
#include "checks_mpi.hpp"
#include "methods.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>

namespace rrcb::hard_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Every method gives every rank the same error, which holds `expected`, and then works again.
void expect_error(const std::string& expected,
                  const std::function<void(Share& share, Options& options)>& break_it,
                  std::span<const Method> tried = methods) {
    const Cloud& cloud = find_cloud("weights_across_the_positions");
    const auto owners = owners_of(cloud, 200, Layout::scattered, num_ranks());
    const Share fine = share_of(cloud, owners, rank());
    for (const Method& method : tried) {
        SCOPED_TRACE(std::string(method.domain_name) + " " + method.refine_name);
        Share broken = fine;
        Options options;
        break_it(broken, options);
        test::expect_same_error([&] { balance(broken.points(), method, options, MPI_COMM_WORLD); },
                                expected);
        const Balance next = balance(fine.points(), method, {}, MPI_COMM_WORLD);
        EXPECT_EQ(next.report.details.num_points, 200);
    }
}

std::string last_rank() {
    return "rank " + std::to_string(num_ranks() - 1) + ": ";
}

TEST(Errors, a_coordinate_that_is_nan) {
    expect_error(last_rank() + "coordinate of point 3 on axis 0 is NaN or infinite (1 such value",
                 [](Share& share, Options&) {
                     if (is_last_rank()) share.coordinates[3] = nan;
                 });
}

TEST(Errors, all_coordinates_are_nan) {
    expect_error("rank 0: coordinate of point 0 on axis 0", [](Share& share, Options&) {
        share.coordinates.assign(share.coordinates.size(), nan);
    });
}

TEST(Errors, a_coordinate_that_is_infinite) {
    for (const double bad : {infinity, -infinity})
        expect_error(last_rank() + "coordinate of point 0 on axis 0", [&](Share& share, Options&) {
            if (is_last_rank()) share.coordinates[0] = bad;
        });
}

TEST(Errors, a_weight_that_is_negative) {
    expect_error(last_rank() +
                     "weight of point 2 is negative, NaN or infinite (1 such value on this rank); "
                     "give 0 or more",
                 [](Share& share, Options&) {
                     if (is_last_rank()) share.weights[2] = -1e-300;
                 });
}

TEST(Errors, a_weight_that_is_nan_or_infinite) {
    for (const double bad : {nan, infinity})
        expect_error(last_rank() + "weight of point 2", [&](Share& share, Options&) {
            if (is_last_rank()) share.weights[2] = bad;
        });
}

TEST(Errors, of_several_ranks_are_told_by_the_lowest) {
    expect_error("rank 0: weight of point 1",
                 [](Share& share, Options&) { share.weights[rank() == 0 ? 1 : 0] = nan; });
}

/// Ranks are compared with the first of their eight, and these with rank 0.
std::string ranks_compared(int differing) {
    const int first = differing - differing % 8;
    return "between rank " + std::to_string(differing == first ? 0 : first) + " and rank " +
           std::to_string(differing);
}

TEST(Errors, options_that_differ_between_ranks) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const auto differs = [](const std::string& name, const std::function<void(Options&)>& change) {
        expect_error(
            name + " differs " + ranks_compared(num_ranks() - 1),
            [&](Share&, Options& options) {
                if (is_last_rank()) change(options);
            },
            own_methods);
    };
    differs("num_parts", [](Options& o) { o.num_parts = 99; });
    differs("cells_per_axis", [](Options& o) { o.expert.cells_per_axis = 7; });
    differs("imbalance_tolerance", [](Options& o) { o.imbalance_tolerance = 1.5; });
    differs("coincident", [](Options& o) { o.expert.coincident = Coincident::divide; });
}

/// No rank may wait for points that others never send, nor leave any behind.
TEST(Errors, a_domain_that_differs_on_any_rank) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const Share share =
        share_of(find_cloud("lattice"),
                 owners_of(find_cloud("lattice"), 200, Layout::scattered, num_ranks()), rank());
    for (const int faulty : {0, 1, num_ranks() / 2}) {
        PaperOptions options;
        if (rank() == faulty) options.domain = PaperDomain::points;
        test::expect_same_error(
            [&] { balance_as_in_paper(share.points(), MPI_COMM_WORLD, options); },
            "domain differs between rank 0 and rank " + std::to_string(std::max(1, faulty)));
        const Balance next = balance_as_in_paper(share.points(), MPI_COMM_WORLD);
        EXPECT_EQ(next.report.details.num_points, 200);
    }
}

TEST(Errors, a_tree_of_earlier_cuts_that_differs_between_ranks) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const std::vector<double> x{0.5 + rank(), 1.25 + rank()};
    const Points points(x, 1);
    Cuts cuts = balance(points, MPI_COMM_WORLD).cuts;
    const Cuts same = cuts;
    if (is_last_rank()) cuts.tree[0].at[0] += 1;
    EXPECT_THROW(balance(points, MPI_COMM_WORLD, {}, cuts), Error);
    EXPECT_EQ(balance(points, MPI_COMM_WORLD, {}, same).parts.size(), 2u);
}

}  // namespace
}  // namespace rrcb::hard_test
