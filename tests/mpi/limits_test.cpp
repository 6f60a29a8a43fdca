// Axes::min_width and Axes::grid on clouds large enough to be searched round by round.
#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/quality.hpp>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Points of the unit square, dense towards the lower left corner, dealt out to the ranks.
std::vector<double> dense_corner(int count, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::vector<double> mine;
    for (int i = 0; i < count; ++i) {
        const double x = test::uniform(engine);
        const double y = test::uniform(engine);
        if (i % num_ranks() == rank()) mine.insert(mine.end(), {x * x * x, y * y});
    }
    return mine;
}

Box box_of_all(const Points& points) {
    Box box = bounding_box(points);
    MPI_Allreduce(MPI_IN_PLACE, box.lower.data(), 3, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, box.upper.data(), 3, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return box;
}

/// Least extent of the parts along an axis that is cut; open sides count to the box of all points.
double least_width(const Cuts& cuts, const Box& box, std::size_t axis) {
    double least = infinity;
    for (Part part = 0; part < cuts.num_parts; ++part) {
        const Box region = box_of(cuts, part);
        if (region.lower[axis] == -infinity && region.upper[axis] == infinity) continue;
        least = std::min(least, std::min(region.upper[axis], box.upper[axis]) -
                                    std::max(region.lower[axis], box.lower[axis]));
    }
    return least;
}

/// What each part holds on all ranks, by a look-up for every point.
std::vector<double> counts_by_look_up(const Cuts& cuts, const Points& points) {
    std::vector<double> counts(static_cast<std::size_t>(cuts.num_parts));
    for (LocalIndex i = 0; i < points.count; ++i)
        counts[static_cast<std::size_t>(part_of(cuts, points.position(i)))] += 1;
    MPI_Allreduce(MPI_IN_PLACE, counts.data(), cuts.num_parts, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return counts;
}

std::string message_of(const Points& points, const Options& options) {
    try {
        balance(points, MPI_COMM_WORLD, options);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
        return error.what();
    }
    return "";
}

TEST(MinWidth, holds_for_every_part_while_the_rest_is_balanced) {
    const auto coordinates = dense_corner(6000, 1);
    const Points points(coordinates, 2);
    const Box box = box_of_all(points);
    for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact}) {
        for (const int num_parts : {2, 5, 12}) {
            Options options{.num_parts = num_parts, .refine = refine};
            const Balance free = balance(points, MPI_COMM_WORLD, options);
            options.expert.axes.min_width = {0.15, 0.1};
            const Balance wide = balance(points, MPI_COMM_WORLD, options);
            EXPECT_GE(least_width(wide.cuts, box, 0), 0.15) << num_parts;
            EXPECT_GE(least_width(wide.cuts, box, 1), 0.1) << num_parts;
            // Parts of a 12th would be narrower in the corner.
            if (num_parts == 12) {
                EXPECT_LT(std::min(least_width(free.cuts, box, 0) - 0.15,
                                   least_width(free.cuts, box, 1) - 0.1),
                          0);
            }
            const auto weights = part_weights(points, wide.parts, num_parts, MPI_COMM_WORLD);
            if (!wide.report.part_weights.empty()) {
                EXPECT_EQ(weights, wide.report.part_weights);
            }
            if (refine != Refine::none && num_parts == 2) {
                EXPECT_LE(imbalance(weights), 1.01);
            }
        }
    }
}

TEST(MinWidth, of_a_fraction_of_the_extent_leaves_one_place_for_each_cut) {
    // 8 x 4 parts of exactly these widths in the box 0 ... 8, 0 ... 2, and not one more.
    std::vector<double> coordinates;
    if (rank() == 0) coordinates = {0, 0, 8, 2};
    for (const double x : dense_corner(500, 2)) coordinates.push_back(2 * x);
    const Points points(coordinates, 2);
    Options options{.num_parts = 32, .expert = {.axes = {.min_width = {1, 0.5}}}};
    const Balance full = balance(points, MPI_COMM_WORLD, options);
    for (const Cut& cut : full.cuts.tree) {
        const double unit = options.expert.axes.min_width[static_cast<std::size_t>(cut.axis)];
        const double value = cut.at[static_cast<std::size_t>(cut.axis)];
        EXPECT_EQ(value, unit * std::round(value / unit));
    }
    options.num_parts = 33;
    EXPECT_EQ(message_of(points, options),
              "rank 0: axes.min_width leaves room for 32 parts, but 33 are asked for; ask "
              "for fewer, or set narrower limits");
    options.num_parts = 32;
    options.expert.axes.min_width[0] = std::nextafter(1, 2);
    EXPECT_EQ(message_of(points, options),
              "rank 0: axes.min_width leaves room for 28 parts, but 32 are asked for; ask "
              "for fewer, or set narrower limits");
}

TEST(MinWidth, tells_when_the_axes_given_leave_no_room) {
    const auto coordinates = dense_corner(1000, 3);
    const Points points(coordinates, 2);
    Options options{
        .num_parts = 4,
        .expert = {.axes = {.order = AxisOrder::given({0, 0, 0}), .min_width = {0.3, 0.1}}}};
    EXPECT_EQ(
        message_of(points, options),
        "rank 0: axes.min_width leaves room for 3 x 4 parts side by side, not enough for the given "
        "axes of the cuts; set narrower limits, or leave the axes free");
    options.expert.axes.order = AxisOrder::given({0, 1, 1});
    EXPECT_EQ(message_of(points, options), "");
    options.expert.axes.order = AxisOrder::grouped({1, 0});
    EXPECT_EQ(message_of(points, options), "");
}

TEST(Grid, holds_all_cuts_on_its_lines) {
    const auto coordinates = dense_corner(6000, 4);
    const Points points(coordinates, 2);
    for (const double spacing : {0.3, 0.02, 1.0 / 1024, 1e-6}) {
        for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact}) {
            Options options{.num_parts = 7,
                            .refine = refine,
                            .expert = {.axes = {.grid = {{0.1, spacing}, {-7, spacing / 3}}}}};
            const Balance result = balance(points, MPI_COMM_WORLD, options);
            for (const Cut& cut : result.cuts.tree) {
                const auto axis = static_cast<std::size_t>(cut.axis);
                const auto [origin, step] = options.expert.axes.grid[axis];
                const double k = std::round((cut.at[axis] - origin) / step);
                EXPECT_EQ(cut.at[axis], origin + k * step);
                EXPECT_EQ(cut.at[1 - axis], -infinity);
                EXPECT_EQ(cut.divides, 0);
            }
            // Lines this near leave at most a few points too many below a cut.
            if (spacing < 1e-5 && refine == Refine::exact) {
                EXPECT_LE(result.report.imbalance, 1.005);
            }
            if (spacing < 1e-2 && refine == Refine::tolerance) {
                EXPECT_LE(result.report.imbalance, 1.01);
            }
        }
    }
}

TEST(Grid, that_coordinates_cannot_tell_apart_is_refused) {
    std::vector<double> coordinates{1e15 + rank(), 3, 1e15, 4};
    const Points points(coordinates, 2);
    Options options{.num_parts = 2, .expert = {.axes = {.grid = {{0, 0.1}, {0, 0.1}}}}};
    EXPECT_EQ(message_of(points, options),
              "rank 0: axes.grid is finer along axis 0 than doubles resolve at these coordinates; "
              "give a larger "
              "spacing");
}

TEST(Limits, that_differ_between_ranks_are_an_error_on_all) {
    if (num_ranks() == 1) GTEST_SKIP();
    const auto coordinates = dense_corner(1000, 5);
    Options options{
        .expert = {.axes = {.min_width = {0.1, rank() == num_ranks() - 1 ? 0.1 : 0.2}}}};
    const std::string message = message_of(Points(coordinates, 2), options);
    EXPECT_NE(message.find("axes.min_width, axes.grid differs between rank"), std::string::npos)
        << message;
}

TEST(Limits, move_earlier_cuts_that_break_them) {
    const auto coordinates = dense_corner(6000, 6);
    const Points points(coordinates, 2);
    const Box box = box_of_all(points);
    Options options{.num_parts = 12};
    const Cuts previous = balance(points, MPI_COMM_WORLD, options).cuts;
    for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact}) {
        options.refine = refine;
        options.imbalance_tolerance = 1.01;
        options.expert.axes.min_width = {0.15, 0.1};
        const Balance moved = balance(points, MPI_COMM_WORLD, options, previous);
        EXPECT_GE(least_width(moved.cuts, box, 0), 0.15);
        EXPECT_GE(least_width(moved.cuts, box, 1), 0.1);
        const auto counts = counts_by_look_up(moved.cuts, points);
        if (refine != Refine::none) {
            EXPECT_EQ(moved.report.part_weights, counts);
            EXPECT_EQ(moved.report.imbalance, imbalance(counts, {}));
        }
        // What keeps them stays as it is.
        options.imbalance_tolerance = imbalance(counts, {});
        const Cuts again = balance(points, MPI_COMM_WORLD, options, moved.cuts).cuts;
        for (std::size_t k = 0; k < again.tree.size(); ++k)
            EXPECT_EQ(again.tree[k].at, moved.cuts.tree[k].at);
    }
}

TEST(Limits, hold_where_nothing_has_weight) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        const auto coordinates = dense_corner(200, seed);
        std::vector<double> weights;
        for (std::size_t i = 0; i < coordinates.size(); i += 2)
            weights.push_back(std::fmod(coordinates[i], 0.25) < 0.02 ? 1 : 0);
        const Points points(coordinates, 2, weights);
        Options options{.num_parts = 11,
                        .refine = Refine::exact,
                        .expert = {.axes = {.min_width = {0.07, 0.07}}, .cells_per_axis = 1}};
        const Cuts cuts = balance(points, MPI_COMM_WORLD, options).cuts;
        EXPECT_GE(least_width(cuts, box_of_all(points), 0), 0.07) << seed;
        EXPECT_GE(least_width(cuts, box_of_all(points), 1), 0.07) << seed;
    }
}

// Differences of such weights leave round-off in parts without points.
TEST(Limits, hold_in_parts_that_only_round_off_weighs) {
    constexpr double width = 0.00034204408186279866;
    std::vector<double> coordinates{0.36400110585025702, 0.56906668243058667, 0.81282294427612944,
                                    0.82641671387208282, 0.10585850610680525};
    std::vector<double> weights{1.0869606592426846, 0.009148669634949572, 2.8524821118285484e-06,
                                1.0676278943739534e-05, 0.0007824389224685591};
    if (rank() > 0) coordinates.clear();
    if (rank() > 0) weights.clear();
    const Points points(coordinates, 1, weights);
    Options options{.num_parts = 10,
                    .imbalance_tolerance = 1.3,
                    .expert = {.coincident = Coincident::divide, .axes = {.min_width = {width}}}};
    for (const bool larger_below : {false, true}) {
        options.expert.tree.larger_below = larger_below;
        const Cuts cuts = balance(points, MPI_COMM_WORLD, options).cuts;
        EXPECT_GE(least_width(cuts, box_of_all(points), 0), width) << larger_below;
        const Cuts again = balance(points, MPI_COMM_WORLD, options, cuts).cuts;
        EXPECT_GE(least_width(again, box_of_all(points), 0), width) << larger_below;
    }
}

TEST(Limits, need_no_points) {
    Options options{.num_parts = 9,
                    .expert = {.axes = {.min_width = {1, 1, 1}, .grid = {{0, 1}, {0, 1}, {0, 1}}}}};
    const Balance result = balance(Points({}, 3), MPI_COMM_WORLD, options);
    EXPECT_EQ(result.cuts.tree.size(), 8u);
}

}  // namespace
}  // namespace rrcb
