// The interface in C beside the one in C++, which is the reference.
#include "c/for_experimental.h"
#include "c/for_fortran.h"
#include "c_calls.hpp"

namespace rrcb {
namespace {

using test::cuts_of;
using test::equal;
using test::expect_refused;

/// A cloud that lies unevenly on the ranks; the second of them holds nothing.
struct Cloud {
    int dimension;
    std::vector<double> coordinates;
    std::vector<double> weights;

    explicit Cloud(int axes) : dimension(axes) {
        std::mt19937_64 random(static_cast<unsigned>(rank() + 1));
        std::uniform_real_distribution<double> uniform(0.1, 1.1);
        const int count = rank() == 1 ? 0 : 300 * (rank() + 1);
        for (int i = 0; i < count * dimension; ++i)
            coordinates.push_back(std::pow(uniform(random), 2));
        for (int i = 0; i < count; ++i) weights.push_back(uniform(random));
    }
    std::size_t count() const { return weights.size(); }
    Points points() const { return Points(coordinates, dimension, weights); }
    rrcb_points in_c() const {
        return rrcb_interleaved_points(RRCB_DOUBLE, dimension, count(), coordinates.data(),
                                       weights.data());
    }
};

class CInterface : public testing::Test {
  protected:
    void SetUp() override { ASSERT_EQ(rrcb_balancer_create(MPI_COMM_WORLD, &balancer), RRCB_OK); }
    void TearDown() override { rrcb_balancer_destroy(&balancer); }

    int balance(const Cloud& cloud) {
        parts.assign(cloud.count(), -1);
        const rrcb_points points = cloud.in_c();
        EXPECT_EQ(rrcb_set_cuts(balancer, nullptr), RRCB_OK);
        return rrcb_balance(balancer, &points, parts.data());
    }

    void expect_as_in_cpp(int dimension, const Options& options,
                          const std::vector<std::pair<const char*, std::string>>& settings);

    rrcb_balancer* balancer = nullptr;
    std::vector<std::int32_t> parts;
};

void expect_same_cuts(const rrcb_cuts& cuts, const Cuts& expected) {
    EXPECT_EQ(cuts.dimension, expected.dimension);
    ASSERT_EQ(cuts.num_parts, expected.num_parts);
    for (std::size_t k = 0; k < expected.tree.size(); ++k) {
        EXPECT_EQ(cuts.tree[k].axis, expected.tree[k].axis);
        EXPECT_EQ(cuts.tree[k].divides, expected.tree[k].divides);
        EXPECT_TRUE(std::ranges::equal(cuts.tree[k].at, expected.tree[k].at));
    }
    EXPECT_EQ(cuts.group_size, expected.shape.group_size);
    EXPECT_EQ(cuts.larger_below, expected.shape.larger_below ? 1 : 0);
    EXPECT_EQ(cuts.round_robin_block, expected.shape.round_robin_block);
    EXPECT_EQ(cuts.numbers == nullptr, expected.numbers.empty());
    EXPECT_EQ(cuts.debt, expected.debt);
}

/// Balances with settings in C and options in C++.
void CInterface::expect_as_in_cpp(
    int dimension, const Options& options,
    const std::vector<std::pair<const char*, std::string>>& settings) {
    const Cloud cloud(dimension);
    for (const auto& [name, value] : settings)
        ASSERT_EQ(rrcb_balancer_set(balancer, name, value.c_str()), RRCB_OK) << rrcb_last_error();
    ASSERT_EQ(rrcb_balancer_set_part_sizes(balancer, options.part_sizes.size(),
                                           options.part_sizes.data()),
              RRCB_OK);
    ASSERT_EQ(balance(cloud), RRCB_OK) << rrcb_last_error();
    const Balance expected = rrcb::balance(cloud.points(), MPI_COMM_WORLD, options);
    EXPECT_EQ(parts, expected.parts);
    rrcb_cuts cuts = RRCB_CUTS_INIT;
    ASSERT_EQ(rrcb_get_cuts(balancer, &cuts), RRCB_OK);
    expect_same_cuts(cuts, expected.cuts);
    rrcb_report report = RRCB_REPORT_INIT;
    ASSERT_EQ(rrcb_get_report(balancer, &report), RRCB_OK);
    EXPECT_EQ(report.num_points, expected.report.details.num_points);
    EXPECT_EQ(report.total_weight, expected.report.details.total_weight);
    EXPECT_EQ(report.imbalance, expected.report.imbalance);
    EXPECT_EQ(report.least_imbalance, expected.report.details.least_imbalance);
    EXPECT_EQ(report.within_tolerance, expected.report.within_tolerance ? 1 : 0);
    EXPECT_EQ(report.kept, expected.report.kept ? 1 : 0);
    EXPECT_EQ(report.rounds, expected.report.details.rounds);
    EXPECT_GT(report.rounds, 0);
}

TEST_F(CInterface, gives_the_parts_cuts_and_report_of_a_call_in_cpp) {
    Options options{.num_parts = 5, .part_sizes = {1, 2, 1, 1, 3}, .refine = Refine::exact};
    for (int dimension = 1; dimension <= 3; ++dimension)
        expect_as_in_cpp(dimension, options, {{"num_parts", "5"}, {"refine", "exact"}});
    options = {.num_parts = 12, .expert = {.axes = {.plain = true}}};
    for (const TreeShape& shape : {TreeShape{}, TreeShape{0}, TreeShape{2}, TreeShape{4, true},
                                   TreeShape{2, false, 1}, TreeShape{4, true, 2}}) {
        options.expert.tree = shape;
        const std::string group = shape.group_size == 0 ? "AUTO" : std::to_string(shape.group_size);
        expect_as_in_cpp(2, options,
                         {{"num_parts", "12"},
                          {"refine", "tolerance"},
                          {"tree.group_size", group},
                          {"tree.larger_below", shape.larger_below ? "ON" : "OFF"},
                          {"tree.round_robin_block", std::to_string(shape.round_robin_block)},
                          {"axes.plain", "on"}});
    }
}

TEST_F(CInterface, starts_from_cuts_that_it_is_given) {
    const Cloud cloud(2);
    ASSERT_EQ(balance(cloud), RRCB_OK);
    const std::vector<std::int32_t> first = parts;
    rrcb_cuts cuts = RRCB_CUTS_INIT;
    ASSERT_EQ(rrcb_get_cuts(balancer, &cuts), RRCB_OK);

    const rrcb_points points = cloud.in_c();
    rrcb_balancer* other = nullptr;
    ASSERT_EQ(rrcb_balancer_create(MPI_COMM_WORLD, &other), RRCB_OK);
    ASSERT_EQ(rrcb_set_cuts(other, &cuts), RRCB_OK);
    parts.assign(cloud.count(), -1);
    ASSERT_EQ(rrcb_assign(other, &points, parts.data()), RRCB_OK);
    EXPECT_EQ(parts, first);
    parts.assign(cloud.count(), -1);
    ASSERT_EQ(rrcb_assign_all(other, &points, parts.data()), RRCB_OK);
    EXPECT_EQ(parts, first);
    parts.assign(cloud.count(), -1);
    ASSERT_EQ(rrcb_balance(other, &points, parts.data()), RRCB_OK);
    EXPECT_EQ(parts, first);

    const Vector middle{0.5, 0.5};
    std::int32_t part = -1;
    ASSERT_EQ(rrcb_part_of(other, middle.data(), &part), RRCB_OK);
    Box box;
    ASSERT_EQ(rrcb_box_of(other, part, box.lower.data(), box.upper.data()), RRCB_OK);
    for (std::size_t a = 0; a < 2; ++a) {
        EXPECT_LE(box.lower[a], middle[a]);
        EXPECT_GE(box.upper[a], middle[a]);
    }
    rrcb_balancer_destroy(&other);
}

TEST_F(CInterface, starts_from_its_cuts_until_they_are_cleared) {
    Cloud cloud(2);
    Options options{.imbalance_tolerance = 1.5};
    ASSERT_EQ(rrcb_balancer_set(balancer, "imbalance_tolerance", "1.5"), RRCB_OK);
    ASSERT_EQ(balance(cloud), RRCB_OK) << rrcb_last_error();
    const Cuts first = rrcb::balance(cloud.points(), MPI_COMM_WORLD, options).cuts;
    for (double& x : cloud.coordinates) x *= 1.01;

    const rrcb_points points = cloud.in_c();
    rrcb_cuts cuts = RRCB_CUTS_INIT;
    ASSERT_EQ(rrcb_balance(balancer, &points, parts.data()), RRCB_OK) << rrcb_last_error();
    ASSERT_EQ(rrcb_get_cuts(balancer, &cuts), RRCB_OK);
    expect_same_cuts(cuts, first);
    const Balance anew = rrcb::balance(cloud.points(), MPI_COMM_WORLD, options);
    ASSERT_EQ(rrcb_set_cuts(balancer, nullptr), RRCB_OK);
    EXPECT_EQ(rrcb_get_cuts(balancer, &cuts), RRCB_INVALID_ARGUMENT);
    ASSERT_EQ(rrcb_balance(balancer, &points, parts.data()), RRCB_OK) << rrcb_last_error();
    ASSERT_EQ(rrcb_get_cuts(balancer, &cuts), RRCB_OK);
    expect_same_cuts(cuts, anew.cuts);
    EXPECT_EQ(parts, anew.parts);
}

TEST_F(CInterface, keeps_uncounted_cuts_within_the_tolerance_only) {
    Cloud cloud(2);
    const Options options{.imbalance_tolerance = 1.1, .refine = Refine::none};
    ASSERT_EQ(rrcb_balancer_set(balancer, "refine", "NONE"), RRCB_OK);
    ASSERT_EQ(rrcb_balancer_set(balancer, "imbalance_tolerance", "1.1"), RRCB_OK);
    ASSERT_EQ(balance(cloud), RRCB_OK) << rrcb_last_error();
    const Cuts first = rrcb::balance(cloud.points(), MPI_COMM_WORLD, options).cuts;
    Cuts cuts = first;
    for (int call = 0; call < 6; ++call) {
        const rrcb_points points = cloud.in_c();
        ASSERT_EQ(rrcb_balance(balancer, &points, parts.data()), RRCB_OK) << rrcb_last_error();
        const Balance expected = rrcb::balance(cloud.points(), MPI_COMM_WORLD, options, cuts);
        EXPECT_EQ(parts, expected.parts);
        cuts = expected.cuts;
        for (double& x : cloud.coordinates) x = std::pow(x, 1.2);
    }
    EXPECT_TRUE(num_ranks() == 1 || cuts.tree[0].at != first.tree[0].at);
}

/// Parts 0 and 2 on the left, for two machines of two ranks, which are dealt in turns.
TEST_F(CInterface, deals_parts_to_the_groups_of_its_cuts) {
    const std::array<rrcb_cut, 3> tree{{{0, 0, {2}}, {0, 0, {1}}, {0, 0, {3}}}};
    const rrcb_cuts given = cuts_of(1, 4, tree.data(), 2, 0, 1);
    ASSERT_EQ(rrcb_set_cuts(balancer, &given), RRCB_OK) << rrcb_last_error();
    rrcb_cuts cuts = RRCB_CUTS_INIT;
    ASSERT_EQ(rrcb_get_cuts(balancer, &cuts), RRCB_OK);
    EXPECT_EQ(cuts.group_size, 2);
    EXPECT_EQ(cuts.round_robin_block, 1);
    for (const auto& [position, expected] : {std::pair{0.5, 0}, {1.5, 2}, {2.5, 1}, {3.5, 3}}) {
        std::int32_t part = -1;
        ASSERT_EQ(rrcb_part_of(balancer, &position, &part), RRCB_OK);
        EXPECT_EQ(part, expected);
        Vector lower, upper;
        ASSERT_EQ(rrcb_box_of(balancer, part, lower.data(), upper.data()), RRCB_OK);
        EXPECT_TRUE(lower[0] <= position && position < upper[0]) << part;
    }
}

TEST_F(CInterface, moves_points_along_the_plan_of_a_call_in_cpp) {
    const Cloud cloud(3);
    ASSERT_EQ(balance(cloud), RRCB_OK);
    ASSERT_EQ(rrcb_plan(balancer, cloud.count(), parts.data()), RRCB_OK);
    rrcb_plan_lists shown = RRCB_PLAN_LISTS_INIT;
    ASSERT_EQ(rrcb_get_plan(balancer, &shown), RRCB_OK);

    const Plan expected = plan(parts, num_ranks(), MPI_COMM_WORLD);
    EXPECT_EQ(shown.num_points, cloud.count());
    EXPECT_TRUE(equal(shown.export_indices, shown.num_exports, expected.export_indices));
    EXPECT_TRUE(equal(shown.export_ranks, shown.num_exports, expected.export_ranks));
    EXPECT_TRUE(equal(shown.export_parts, shown.num_exports, expected.export_parts));
    EXPECT_TRUE(equal(shown.import_ranks, shown.num_imports, expected.import_ranks));
    EXPECT_TRUE(equal(shown.import_indices, shown.num_imports, expected.import_indices));
    EXPECT_TRUE(equal(shown.import_parts, shown.num_imports, expected.import_parts));

    std::vector<double> here(3 * shown.num_points_after);
    std::vector<std::int32_t> parts_here(shown.num_points_after);
    const std::array moved{
        rrcb_column RRCB_COLUMN_INIT(RRCB_DOUBLE, 3, cloud.coordinates.data(), here.data()),
        rrcb_column RRCB_COLUMN_INIT(RRCB_INT32, 1, parts.data(), parts_here.data())};
    rrcb_transfer_options options = RRCB_TRANSFER_OPTIONS_INIT;
    options.max_bytes = 1 << 12;
    rrcb_transfer_report report = RRCB_TRANSFER_REPORT_INIT;
    options.report = &report;
    ASSERT_EQ(rrcb_transfer(balancer, 2, moved.data(), &options), RRCB_OK);
    EXPECT_EQ(here, transfer(expected, column(cloud.coordinates, 3), MPI_COMM_WORLD));
    EXPECT_EQ(parts_here, transfer(expected, parts, MPI_COMM_WORLD));
    EXPECT_EQ(report.bytes_sent, 28 * shown.num_exports);
    EXPECT_LE(report.peak_bytes, options.max_bytes);
}

TEST_F(CInterface, refuses_a_plan_of_fewer_points_than_were_balanced) {
    const Cloud cloud(2);
    ASSERT_EQ(balance(cloud), RRCB_OK);
    const auto plan_of_first = [&](std::size_t count_on_first) {
        return rrcb_plan(balancer, rank() == 0 ? count_on_first : cloud.count(), parts.data());
    };
    expect_refused(plan_of_first(1), "rank 0: count is 1, but 300 points were balanced");
    EXPECT_EQ(plan_of_first(300), RRCB_OK);
    // Of points that have moved since, there may be fewer.
    rrcb_points points = cloud.in_c();
    if (rank() == 0) points.count = 1;
    ASSERT_EQ(rrcb_assign_all(balancer, &points, parts.data()), RRCB_OK) << rrcb_last_error();
    EXPECT_EQ(plan_of_first(1), RRCB_OK) << rrcb_last_error();
    ASSERT_EQ(balance(cloud), RRCB_OK);
    ASSERT_EQ(rrcb_assign(balancer, &points, parts.data()), RRCB_OK);
    EXPECT_EQ(plan_of_first(1), RRCB_OK) << rrcb_last_error();
}

TEST_F(CInterface, what_is_wrong_on_one_rank_fails_on_all) {
    Cloud cloud(2);
    cloud.coordinates.insert(cloud.coordinates.end(), {0.5, 0.5});
    cloud.weights.push_back(1);
    parts.resize(cloud.count());
    const auto call = [&](int dimension, const double* coordinates, std::int32_t* out) {
        const rrcb_points points =
            rrcb_interleaved_points(RRCB_DOUBLE, dimension, cloud.count(), coordinates, nullptr);
        return rrcb_balance(balancer, &points, out);
    };
    const double* coordinates = cloud.coordinates.data();
    const auto num_parts = static_cast<std::size_t>(num_ranks());
    expect_refused(call(2, is_last_rank() ? nullptr : coordinates, parts.data()),
                   "coordinates is null");
    expect_refused(
        call(2, coordinates, is_last_rank() ? nullptr : parts.data()),
        "it must hold " + std::to_string(num_ranks() == 2 ? 1 : 300 * num_ranks() + 1) + " entr");
    expect_refused(call(is_last_rank() ? 4 : 2, coordinates, parts.data()), "dimension");
    if (is_last_rank()) cloud.coordinates.back() = std::numeric_limits<double>::quiet_NaN();
    expect_refused(call(2, coordinates, parts.data()), "NaN");

    if (is_last_rank()) cloud.coordinates.back() = 0.5;
    ASSERT_EQ(call(2, coordinates, parts.data()), RRCB_OK) << rrcb_last_error();
    const rrcb_points points = cloud.in_c();
    const rrcb_points* given = is_last_rank() ? nullptr : &points;
    std::int32_t* none_there = is_last_rank() ? nullptr : parts.data();
    double fraction;
    expect_refused(rrcb_balance(balancer, given, parts.data()), "points is null");
    for (const int code : {rrcb_assign_all(balancer, &points, none_there),
                           rrcb_balance(balancer, &points, none_there),
                           rrcb_plan(balancer, cloud.count(), none_there),
                           rrcb_moved_fraction(balancer, &points, none_there, &fraction)})
        expect_refused(code, "parts is null");
    expect_refused(rrcb_remap(balancer, cloud.count(), parts.data(), nullptr, nullptr, num_parts,
                              none_there, nullptr),
                   "numbers is null");
    expect_refused(rrcb_remap(balancer, cloud.count(), parts.data(), nullptr, nullptr,
                              is_last_rank() ? num_parts - 1 : num_parts, parts.data(), nullptr),
                   "give an array with an entry for each");
    expect_refused(rrcb_part_weights(balancer, &points, parts.data(), num_parts,
                                     is_last_rank() ? nullptr : &fraction),
                   "result is null");
}

TEST_F(CInterface, columns_that_are_wrong_on_one_rank_fail_on_all) {
    // Every rank holds a point of each part, so that points come to all.
    std::vector<double> x(static_cast<std::size_t>(num_ranks()));
    std::iota(x.begin(), x.end(), 0.0);
    parts.resize(x.size());
    const rrcb_points points = rrcb_interleaved_points(RRCB_DOUBLE, 1, x.size(), x.data(), nullptr);
    ASSERT_EQ(rrcb_balance(balancer, &points, parts.data()), RRCB_OK);
    ASSERT_EQ(rrcb_plan(balancer, x.size(), parts.data()), RRCB_OK);
    std::vector<double> here(x.size());
    const rrcb_column right = RRCB_COLUMN_INIT(RRCB_DOUBLE, 1, x.data(), here.data());
    const auto move = [&](const rrcb_column& there) {
        return rrcb_transfer(balancer, 1, is_last_rank() ? &there : &right, nullptr);
    };
    expect_refused(move(RRCB_COLUMN_INIT(RRCB_DOUBLE, 1, nullptr, here.data())),
                   "from of column 0 (the first is 0) is null");
    const std::string fix = "must hold 2 for each of " + std::to_string(x.size()) + " points";
    expect_refused(move(RRCB_COLUMN_INIT(RRCB_DOUBLE, 2, x.data(), nullptr)), fix);
    expect_refused(move(RRCB_COLUMN_INIT(static_cast<rrcb_type>(7), 1, x.data(), here.data())),
                   "rrcb_type");
    expect_refused(move(RRCB_COLUMN_INIT(RRCB_DOUBLE, 0, x.data(), here.data())),
                   "components of a column must be 1 or more");
    expect_refused(rrcb_transfer(balancer, 1, is_last_rank() ? nullptr : &right, nullptr),
                   "columns is null");
    if (num_ranks() > 1) {
        expect_refused(move(RRCB_COLUMN_INIT(RRCB_FLOAT, 1, x.data(), here.data())), "4 bytes");
        expect_refused(move(RRCB_COLUMN_INIT(RRCB_INT64, 1, x.data(), here.data())), "whole");
    }
    ASSERT_EQ(move(right), RRCB_OK);
}

TEST_F(CInterface, options_that_differ_fail_on_all) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    ASSERT_EQ(rrcb_balancer_set(balancer, "imbalance_tolerance", is_last_rank() ? "1.1" : "1.2"),
              RRCB_OK);
    expect_refused(balance(Cloud(2)), "imbalance_tolerance");
    rrcb_cuts cuts = cuts_of(2, 1, nullptr);
    rrcb_balancer* none = nullptr;
    expect_refused(rrcb_balancer_create(MPI_COMM_NULL, &none), "COMM_NULL");
    EXPECT_EQ(none, nullptr);
    rrcb_balancer** const room = is_last_rank() ? nullptr : &none;
    expect_refused(rrcb_balancer_create(MPI_COMM_WORLD, room), "null");
    EXPECT_EQ(none, nullptr);
    EXPECT_EQ(rrcb_set_cuts(balancer, &cuts), RRCB_OK);
}

TEST_F(CInterface, names_what_it_does_not_know) {
    EXPECT_EQ(rrcb_balancer_set(balancer, "colour", "blue"), RRCB_INVALID_ARGUMENT);
    EXPECT_STREQ(rrcb_last_error(), "there is no option \"colour\"; docs/parameters.md lists them");
    expect_refused(rrcb_balancer_set(balancer, "tolerance", "1.1"),
                   "did you mean imbalance_tolerance?");
    expect_refused(rrcb_balancer_set(balancer, "tree.group_size", "OFF"),
                   "or 0 or AUTO for the parts of each machine");
    expect_refused(rrcb_balancer_set(balancer, "part_sizes", "1 2"),
                   "call rrcb_balancer_set_part_sizes");
    expect_refused(rrcb_balancer_set(balancer, "refine", "twice"), "EXACT");
    EXPECT_EQ(rrcb_balancer_set(nullptr, "refine", "NONE"), RRCB_INVALID_ARGUMENT);
    EXPECT_STREQ(rrcb_last_error(), "balancer is null: it was not created, or is destroyed");
    const rrcb_cuts no_tree = cuts_of(2, 3, nullptr);
    EXPECT_EQ(rrcb_set_cuts(balancer, &no_tree), RRCB_INVALID_ARGUMENT);
    const rrcb_cuts no_parts = cuts_of(2, 0, nullptr);
    EXPECT_EQ(rrcb_set_cuts(balancer, &no_parts), RRCB_INVALID_ARGUMENT);
    const rrcb_cuts no_group = cuts_of(2, 1, nullptr, 0, 0, 0);
    expect_refused(rrcb_set_cuts(balancer, &no_group), "groups of 1 or more");
    for (const int dimension : {-1, 0, 4, 9}) {
        const rrcb_cuts nowhere = cuts_of(dimension, 1, nullptr);
        expect_refused(rrcb_set_cuts(balancer, &nowhere), "1, 2 or 3 dimensions");
    }
    rrcb_balancer_destroy(nullptr);
}

TEST_F(CInterface, refuses_numbers_that_a_flag_does_not_have) {
    for (const std::int32_t flag : {-1, 2, 55}) {
        const rrcb_cut cut{0, flag, {1}};
        const rrcb_cuts divided = cuts_of(1, 2, &cut);
        expect_refused(rrcb_set_cuts(balancer, &divided), "divides that is neither 0 nor 1");
        const rrcb_cuts large = cuts_of(1, 1, nullptr, 1, flag, 0);
        expect_refused(rrcb_set_cuts(balancer, &large), "larger_below must be 0 or 1");
    }
}

TEST_F(CInterface, refuses_to_show_what_it_does_not_have_yet) {
    const auto expect_missing = [](int code, const std::string& what) {
        expect_refused(code, "the balancer has no " + what);
    };
    rrcb_report report = RRCB_REPORT_INIT;
    rrcb_cuts cuts = RRCB_CUTS_INIT;
    rrcb_plan_lists plan = RRCB_PLAN_LISTS_INIT;
    Box box;
    std::int32_t part = 0;
    double x[] = {0.5, 0.5};
    double y[2];
    const rrcb_points points = rrcb_interleaved_points(RRCB_DOUBLE, 2, 1, x, nullptr);
    const rrcb_column column = RRCB_COLUMN_INIT(RRCB_DOUBLE, 1, x, y);
    const rrcb_ghost_options options = RRCB_GHOST_OPTIONS_INIT;
    rrcb_ghosts* ghosts = nullptr;
    std::size_t count = 0;
    expect_missing(rrcb_get_report(balancer, &report), "report yet");
    expect_missing(rrcb_get_cuts(balancer, &cuts), "cuts yet");
    expect_missing(rrcb_get_plan(balancer, &plan), "plan yet");
    expect_missing(rrcb_box_of(balancer, 0, box.lower.data(), box.upper.data()), "cuts yet");
    expect_missing(rrcb_assign(balancer, &points, &part), "cuts yet");
    expect_missing(rrcb_assign_all(balancer, &points, &part), "cuts yet");
    expect_missing(rrcb_plan(balancer, 1, &part), "cuts yet");
    expect_missing(rrcb_transfer(balancer, 1, &column, nullptr), "plan yet");
    expect_missing(rrcb_part_of(balancer, x, &part), "cuts yet");
    expect_missing(rrcb_parts_touching(balancer, x, x, 1, &part, &count), "cuts yet");
    expect_missing(rrcb_part_weights(balancer, &points, &part, 1, y), "cuts yet");
    expect_missing(rrcb_remap(balancer, 1, &part, nullptr, nullptr, 1, &part, nullptr), "cuts yet");
    expect_missing(rrcb_ghosts_create(balancer, &points, &options, &ghosts), "cuts yet");

    const rrcb_cuts given = cuts_of(2, 1, nullptr);
    ASSERT_EQ(rrcb_set_cuts(balancer, &given), RRCB_OK);
    EXPECT_EQ(rrcb_get_cuts(balancer, &cuts), RRCB_OK);
    EXPECT_EQ(rrcb_assign(balancer, &points, &part), RRCB_OK);
    for (const std::int32_t none : {-1, 1, 1000})
        EXPECT_EQ(rrcb_box_of(balancer, none, box.lower.data(), box.upper.data()),
                  RRCB_INVALID_ARGUMENT);
    expect_missing(rrcb_get_report(balancer, &report), "report yet");
    expect_missing(rrcb_get_plan(balancer, &plan), "plan yet");
}

TEST(CController, decides_as_the_controller_in_cpp) {
    rrcb_controller* controller = nullptr;
    ASSERT_EQ(rrcb_controller_create(MPI_COMM_WORLD, &controller), RRCB_OK);
    Controller in_cpp(MPI_COMM_WORLD);
    in_cpp.rebalanced({.cost = 0.5});
    EXPECT_EQ(rrcb_controller_rebalanced(controller, nullptr, 0.5), RRCB_OK);
    int num_due = 0;
    for (int step = 0; step < 40; ++step) {
        const double load = 1 + (rank() == 0 ? 0.01 * step : 0);
        int due = -1;
        int still_due = -1;
        const double weight = 1;
        EXPECT_EQ(rrcb_controller_step(controller, load, step < 20 ? nullptr : &weight, &due),
                  RRCB_OK);
        EXPECT_EQ(rrcb_controller_due(controller, &still_due), RRCB_OK);
        EXPECT_EQ(due, still_due);
        EXPECT_EQ(due == 1, step < 20 ? in_cpp.step({load}) : in_cpp.step({load, weight}));
        num_due += due;
    }
    EXPECT_EQ(num_due > 0, num_ranks() > 1);
    rrcb_controller_destroy(&controller);
}

TEST(CController, refuses_bad_loads_and_null) {
    EXPECT_EQ(rrcb_controller_step(nullptr, 1, nullptr, nullptr), RRCB_INVALID_ARGUMENT);
    rrcb_controller* controller = nullptr;
    ASSERT_EQ(rrcb_controller_create_fortran(MPI_Comm_c2f(MPI_COMM_WORLD), &controller), RRCB_OK);
    EXPECT_EQ(rrcb_controller_step(controller, is_last_rank() ? -1 : 1, nullptr, nullptr), RRCB_OK);
    expect_refused(rrcb_controller_step(controller, 1, nullptr, nullptr), "the load");
    rrcb_controller_destroy(&controller);
}

/// Steps in which a point takes 2 s and a cell 5 s; each rank has other cells.
void record_steps(rrcb_cost_model* model, int num_steps) {
    for (int step = 0; step < num_steps; ++step) {
        const std::array columns{100.0, 10.0 * (rank() + 1) + step % 7};
        ASSERT_EQ(rrcb_cost_model_step(model, 2 * columns[0] + 5 * columns[1], 2, columns.data()),
                  RRCB_OK);
    }
}

TEST(CCostModel, weighs_points_as_the_model_in_cpp) {
    rrcb_controller* controller = nullptr;
    rrcb_cost_model* model = nullptr;
    ASSERT_EQ(rrcb_controller_create(MPI_COMM_WORLD, &controller), RRCB_OK);
    ASSERT_EQ(rrcb_cost_model_create(MPI_COMM_WORLD, controller, 2, &model), RRCB_OK);
    record_steps(model, 30);
    int uses_costs = -1;
    EXPECT_EQ(rrcb_cost_model_uses_costs(model, &uses_costs), RRCB_OK);
    EXPECT_EQ(uses_costs, num_ranks() > 1 ? 1 : 0);
    std::array<double, 2> values{};
    EXPECT_EQ(rrcb_cost_model_costs(model, values.size(), values.data()), RRCB_OK);
    EXPECT_NEAR(values[0], 2, 0.01);
    EXPECT_NEAR(values[1], 5, 0.01);
    const std::array columns{1.0, 0.5, 1.0, 0.0};
    EXPECT_EQ(rrcb_cost_model_weights(model, 2, 2, columns.data(), values.data()), RRCB_OK);
    EXPECT_NEAR(values[0], num_ranks() > 1 ? 4.5 : 1, 0.01);
    EXPECT_NE(std::string(rrcb_cost_model_report(model)), "");
    rrcb_cost_model_destroy(&model);
    rrcb_controller_destroy(&controller);
}

TEST_F(CInterface, saves_and_loads_cuts) {
    ASSERT_EQ(balance(Cloud(3)), RRCB_OK);
    const void* bytes = nullptr;
    std::size_t size = 0;
    ASSERT_EQ(rrcb_save_cuts(balancer, &bytes, &size), RRCB_OK) << rrcb_last_error();
    rrcb_balancer* other = nullptr;
    ASSERT_EQ(rrcb_balancer_create(MPI_COMM_WORLD, &other), RRCB_OK);
    EXPECT_EQ(rrcb_load_cuts(other, bytes, size - 1), RRCB_INVALID_ARGUMENT);
    EXPECT_EQ(rrcb_load_cuts(other, nullptr, size), RRCB_INVALID_ARGUMENT);
    ASSERT_EQ(rrcb_load_cuts(other, bytes, size), RRCB_OK) << rrcb_last_error();
    rrcb_cuts cuts = RRCB_CUTS_INIT;
    ASSERT_EQ(rrcb_get_cuts(other, &cuts), RRCB_OK);
    expect_same_cuts(cuts, load<Cuts>({static_cast<const std::byte*>(bytes), size}));
    EXPECT_EQ(rrcb_save_cuts(balancer, nullptr, &size), RRCB_INVALID_ARGUMENT);
    rrcb_balancer_destroy(&other);
}

TEST(CCostModel, continues_from_saved_bytes) {
    const auto step = [](rrcb_cost_model* model, int number) {
        const double columns[] = {100, 10.0 + 20.0 * rank() + number % 7};
        EXPECT_EQ(rrcb_cost_model_step(model, columns[0] + 5 * columns[1], 2, columns), RRCB_OK);
    };
    rrcb_controller* controllers[2] = {};
    rrcb_cost_model* models[2] = {};
    ASSERT_EQ(rrcb_controller_create(MPI_COMM_WORLD, &controllers[0]), RRCB_OK);
    ASSERT_EQ(rrcb_cost_model_create(MPI_COMM_WORLD, controllers[0], 2, &models[0]), RRCB_OK);
    for (int k = 0; k < 30; ++k) step(models[0], k);
    const void *bytes = nullptr, *of_model = nullptr;
    std::size_t size = 0, size_of_model = 0;
    ASSERT_EQ(rrcb_controller_save(controllers[0], &bytes, &size), RRCB_OK) << rrcb_last_error();
    ASSERT_EQ(rrcb_cost_model_save(models[0], &of_model, &size_of_model), RRCB_OK);
    expect_refused(rrcb_controller_load(MPI_COMM_WORLD, nullptr, size, &controllers[1]),
                   "no state");
    ASSERT_EQ(rrcb_controller_load(MPI_COMM_WORLD, bytes, size, &controllers[1]), RRCB_OK)
        << rrcb_last_error();
    ASSERT_EQ(
        rrcb_cost_model_load(MPI_COMM_WORLD, controllers[1], of_model, size_of_model, &models[1]),
        RRCB_OK)
        << rrcb_last_error();
    for (int k = 30; k < 40; ++k) {
        double costs[2][2];
        for (int which : {0, 1}) {
            step(models[which], k);
            int num_columns = 0;
            EXPECT_EQ(rrcb_cost_model_num_columns(models[which], &num_columns), RRCB_OK);
            EXPECT_EQ(num_columns, 2);
            EXPECT_EQ(rrcb_cost_model_costs(models[which], 2, costs[which]), RRCB_OK);
        }
        EXPECT_EQ(costs[0][0], costs[1][0]);
        EXPECT_EQ(costs[0][1], costs[1][1]);
    }
    for (rrcb_cost_model* model : models) rrcb_cost_model_destroy(&model);
    for (rrcb_controller* controller : controllers) rrcb_controller_destroy(&controller);
}

TEST(CCostModel, tells_all_ranks_of_a_null_pointer_on_one) {
    rrcb_controller* controller = nullptr;
    rrcb_cost_model* model = nullptr;
    const bool is_null = rank() == 0;
    EXPECT_EQ(rrcb_controller_create(MPI_COMM_WORLD, is_null ? nullptr : &controller),
              RRCB_INVALID_ARGUMENT);
    EXPECT_EQ(rrcb_cost_model_create(MPI_COMM_WORLD, nullptr, 1, is_null ? nullptr : &model),
              RRCB_INVALID_ARGUMENT);
    EXPECT_EQ(controller, nullptr);
    EXPECT_EQ(model, nullptr);
}

TEST(CPoints, of_a_negative_count_are_refused) {
    const double x[2] = {0, 0};
    const rrcb_points points =
        rrcb_interleaved_points(RRCB_DOUBLE, 2, static_cast<std::size_t>(-1), x, nullptr);
    double lower[3], upper[3];
    EXPECT_EQ(rrcb_bounding_box(&points, lower, upper), RRCB_INVALID_ARGUMENT);
}

TEST(CCostModel, with_a_controller_on_some_ranks_alone_is_refused) {
    if (num_ranks() == 1) return;
    rrcb_controller* controller = nullptr;
    ASSERT_EQ(rrcb_controller_create(MPI_COMM_WORLD, &controller), RRCB_OK);
    rrcb_cost_model* model = nullptr;
    EXPECT_EQ(rrcb_cost_model_create(MPI_COMM_WORLD, rank() == 0 ? nullptr : controller, 1, &model),
              RRCB_INVALID_ARGUMENT);
    EXPECT_EQ(model, nullptr);
    rrcb_controller_destroy(&controller);
}

TEST(CCostModel, returns_errors) {
    rrcb_cost_model* model = nullptr;
    const MPI_Fint comm = MPI_Comm_c2f(MPI_COMM_WORLD);
    EXPECT_EQ(rrcb_cost_model_create_fortran(comm, nullptr, 0, &model), RRCB_INVALID_ARGUMENT);
    rrcb_controller* never_made = nullptr;
    EXPECT_EQ(rrcb_cost_model_create_fortran(comm, &never_made, 1, &model), RRCB_INVALID_ARGUMENT);
    ASSERT_EQ(rrcb_cost_model_create_fortran(comm, nullptr, 1, &model), RRCB_OK);
    EXPECT_EQ(rrcb_cost_model_step(model, 1, 1, nullptr), RRCB_OK);
    const double one = 1;
    EXPECT_EQ(rrcb_cost_model_step(model, 1, 1, &one), RRCB_INVALID_ARGUMENT);
    EXPECT_EQ(rrcb_cost_model_weights(model, 1, 1, nullptr, nullptr), RRCB_INVALID_ARGUMENT);
    expect_refused(rrcb_cost_model_weights(model, 0, 2, nullptr, nullptr), "has 1 columns, not 2");
    for (const std::size_t many : {SIZE_MAX / 4 + 1, SIZE_MAX}) {
        double weight = 0;
        expect_refused(rrcb_cost_model_weights(model, many, 1, &one, &weight),
                       "count is the number of points");
    }
    EXPECT_EQ(rrcb_cost_model_step(nullptr, 1, 1, &one), RRCB_INVALID_ARGUMENT);
    EXPECT_STREQ(rrcb_cost_model_report(nullptr), "");
    rrcb_cost_model_destroy(&model);
}

}  // namespace
}  // namespace rrcb
