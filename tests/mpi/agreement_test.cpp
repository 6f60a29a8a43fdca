#include "../support/same_error.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/groups.hpp>
#include <rrcb/paper.hpp>
#include <rrcb/quality.hpp>

namespace rrcb {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

class Agreement : public testing::Test {
  protected:
    void SetUp() override {
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &num_ranks_);
    }

    /// Every rank gets the same text, which holds `expected`, and the next call works.
    void expect_error(const Points& points, const Options& options, const std::string& expected) {
        test::expect_same_error([&] { balance(points, MPI_COMM_WORLD, options); }, expected);

        const std::vector<double> fine{0.5, 1.5};
        EXPECT_EQ(balance(Points(fine, 1), MPI_COMM_WORLD).parts.size(), 2u);
    }

    bool last() const { return rank_ == num_ranks_ - 1; }
    std::string last_rank() const { return "rank " + std::to_string(num_ranks_ - 1) + ": "; }

    int rank_ = 0;
    int num_ranks_ = 1;
};

TEST_F(Agreement, on_a_coordinate_that_is_no_number) {
    for (const double bad : {nan, infinity, -infinity}) {
        std::vector<double> x{0, 1, 2, 3, 4, 5};
        if (last()) x[3] = x[5] = bad;
        expect_error(Points(x, 2), {},
                     last_rank() +
                         "coordinate of point 1 on axis 1 is NaN or infinite (2 such "
                         "values on this rank)");
    }
}

TEST_F(Agreement, on_weights_whose_sum_overflows) {
    const std::vector<double> x{0, 1};
    const std::vector<double> weights(2, last() ? 1e308 : 1.0);
    expect_error(Points(x, 1, weights), {}, last_rank() + "the sum of the weights");
}

TEST_F(Agreement, on_weights_whose_sum_over_the_ranks_overflows) {
    const std::vector<double> x{0};
    const std::vector<double> weights{1.7e308};
    if (num_ranks_ > 1) expect_error(Points(x, 1, weights), {}, "weights of all ranks overflows");
}

TEST_F(Agreement, on_arrays_that_do_not_fit) {
    const std::vector<double> x(last() ? 5 : 4);
    expect_error(Points(x, 2), {}, "multiple of the dimension");
    const std::vector<double> y(last() ? 1 : 2);
    expect_error(Points(y, 2), {}, "multiple of the dimension");
    const std::vector<double> weights(last() ? 1 : 2);
    const std::vector<double> z(4);
    expect_error(Points(z, 2, weights), {}, "one entry per point");
}

TEST_F(Agreement, on_columns_of_other_lengths_and_strides) {
    const std::vector<double> x(12);
    const std::vector<double> y(last() ? 11 : 12);
    const std::vector<std::span<const double>> columns{x, y};
    expect_error(Points(columns), {}, "coordinate arrays must all have the same length");
    Points points(x, 2);
    points.stride = last() ? 0 : points.stride;
    expect_error(points, {}, last_rank() + "the stride of the points must be in bytes");
}

TEST_F(Agreement, on_a_dimension_out_of_range) {
    const std::vector<double> x(12);
    expect_error(Points(x, last() ? 4 : 3), {}, "1, 2 or 3 dimensions");
    expect_error(Points(x, last() ? 0 : 2), {}, "1, 2 or 3 dimensions");
}

TEST_F(Agreement, on_options_out_of_range) {
    const std::vector<double> x{0, 1};
    const auto with = [&](auto change, const std::string& expected) {
        Options options;
        change(options);
        expect_error(Points(x, 1), options, "rank 0: " + expected);
    };
    with([](Options& o) { o.num_parts = -1; }, "num_parts");
    with([](Options& o) { o.expert.cells_per_axis = 5000; }, "cells_per_axis must be 1 ... 4096");
    with([](Options& o) { o.refine = static_cast<Refine>(-3); }, "refine must be NONE");
    with([](Options& o) { o.expert.coincident = static_cast<Coincident>(7); },
         "coincident must be");
    with([](Options& o) { o.num_parts = 2, o.part_sizes = {1}; }, "part_sizes must hold one");
    with([](Options& o) { o.num_parts = 2, o.part_sizes = {0, 0}; }, "part_sizes must have a");
    with([](Options& o) { o.num_parts = 2, o.part_sizes = {2, -1}; }, "part_sizes must be finite");
    with([](Options& o) { o.imbalance_tolerance = 0.9; },
         "imbalance_tolerance must be finite and at least 1");
    with(
        [](Options& o) {
            o.expert.axes.order = AxisOrder::grouped({0, 0});
        },
        "axes.order must name every axis of the points once if it groups them, 0");
    with(
        [](Options& o) {
            o.expert.axes.order = AxisOrder::grouped({1, 2});
        },
        "axes.order must name every axis");
    for (const std::vector<int>& axes : {std::vector<int>{}, {2}, {0, 0}})
        with([&](Options& o) { o.expert.axes.order = AxisOrder::among(axes); },
             "axes.order must name");
    with([](Options& o) { o.num_parts = 3, o.expert.axes.order = AxisOrder::given({0}); },
         "axes.order must hold one axis");
    with([](Options& o) { o.num_parts = 2, o.expert.axes.order = AxisOrder::given({1}); },
         "axes.order must hold axes");
}

TEST_F(Agreement, on_options_that_differ_between_ranks) {
    if (num_ranks_ == 1) GTEST_SKIP() << "needs two ranks";
    const std::vector<double> x{0, 1};
    const auto with = [&](auto change, const std::string& name) {
        Options options;
        if (last()) change(options);
        expect_error(Points(x, 1), options,
                     name + " differs between rank 0 and rank " + std::to_string(num_ranks_ - 1));
    };
    with([](Options& o) { o.num_parts = 99; }, "num_parts");
    with([](Options& o) { o.expert.cells_per_axis = 3; }, "cells_per_axis");
    with([](Options& o) { o.refine = Refine::exact; }, "refine");
    with([](Options& o) { o.imbalance_tolerance = 2; }, "imbalance_tolerance");
    with([](Options& o) { o.expert.axes.plain = true; }, "axes.plain");
    with([](Options& o) { o.expert.tree.larger_below = true; }, "tree.larger_below");
    with([](Options& o) { o.expert.axes.min_width = {1}; },
         "one of axes.order, axes.min_width, axes.grid");
    with([&](Options& o) { o.part_sizes.assign(static_cast<std::size_t>(num_ranks_), 2.0); },
         "part_sizes");
    const std::vector<double> empty;
    expect_error(Points(empty, last() ? 2 : 3), {}, "dimension differs");
}

TEST_F(Agreement, on_weights_given_on_some_ranks) {
    if (num_ranks_ == 1) GTEST_SKIP() << "needs two ranks";
    const std::vector<double> x{0, 1};
    const std::vector<double> weights{2};
    const std::vector<Part> parts(1);
    const std::vector<std::uint64_t> keys(1);
    const Points points = last() ? Points(x, 2) : Points(x, 2, weights);
    const std::string expected = "whether points have weights differs between rank 0 and rank " +
                                 std::to_string(num_ranks_ - 1) + "; give one for each point";
    const MPI_Comm comm = MPI_COMM_WORLD;
    expect_error(points, {}, expected);
    const Cuts cuts = balance(Points(x, 2), comm).cuts;
    test::expect_same_error([&] { balance(points, comm, {}, cuts); }, expected);
    test::expect_same_error([&] { balance_as_in_paper(points, comm); }, expected);
    test::expect_same_error([&] { part_weights(points, parts, 1, comm); }, expected);
    test::expect_same_error([&] { moved_fraction(points, parts, 1, comm); }, expected);
    test::expect_same_error([&] { (void)groups(points, keys, comm); }, expected);

    const Points none({}, 2);
    EXPECT_EQ(balance(last() ? none : points, comm).report.details.total_weight,
              2 * (num_ranks_ - 1));
}

TEST_F(Agreement, on_earlier_cuts_that_do_not_fit) {
    const std::vector<double> x{0, 1, 2, 3};
    Options options{.num_parts = 3};
    const Cuts cuts = balance(Points(x, 2), MPI_COMM_WORLD, options).cuts;
    options.num_parts = last() ? 4 : 3;
    EXPECT_THROW(balance(Points(x, 2), MPI_COMM_WORLD, options, cuts), Error);
    options.num_parts = 3;
    EXPECT_THROW(balance(Points(x, 1), MPI_COMM_WORLD, options, cuts), Error);
    EXPECT_EQ(balance(Points(x, 2), MPI_COMM_WORLD, options, cuts).parts.size(), 2u);
}

}  // namespace
}  // namespace rrcb
