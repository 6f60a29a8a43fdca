// Look-ups by a part of a tree beside those by the whole one.
#include "../support/partial_cuts.hpp"

#include "../support/clouds.hpp"
#include "cuts/packed_tree.hpp"
#include "passes/assignment.hpp"

#include <rrcb/error.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace rrcb {
namespace {

using test::knows;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Points on a small lattice, cuts through them, some of which break ties, and a part of the tree.
struct Case {
    std::vector<double> coordinates;
    std::vector<double> weights;
    Points points;
    Cuts whole;
    Cuts some;

    Case(int dimension, int num_parts, std::size_t num_known, std::mt19937_64& engine)
        : whole{dimension, num_parts, {}}, some{} {
        for (std::size_t i = 0; i < 900 * static_cast<std::size_t>(dimension); ++i)
            coordinates.push_back(static_cast<double>(engine() % 9) - 4);
        for (std::size_t i = 0; i < 900; ++i) weights.push_back(test::uniform(engine));
        points = interleaved_points(coordinates, dimension, weights);
        for (int k = 1; k < num_parts; ++k) add_cut(k, engine);
        std::vector<Part> known;
        for (std::size_t k = 0; k < num_known; ++k)
            known.push_back(static_cast<Part>(engine() % static_cast<unsigned>(num_parts)));
        some = test::cut_down(whole, known);
    }

    void add_cut(int k, std::mt19937_64& engine) {
        Cut cut;
        cut.axis = static_cast<std::int32_t>(engine() % static_cast<unsigned>(whole.dimension));
        cut.divides = k % 5 == 0 ? 1 : 0;
        cut.at.fill(-infinity);
        const Vector x = points.position(engine() % points.count);
        if (k % 3 == 0) cut.at = x;
        cut.at[static_cast<std::size_t>(cut.axis)] = x[static_cast<std::size_t>(cut.axis)];
        whole.tree.push_back(cut);
    }
};

template <class Test>
void for_each_case(Test&& run) {
    std::mt19937_64 engine(7);
    for (const int dimension : {1, 2, 3})
        for (const int num_parts : {2, 3, 9, 64, 1000})
            for (const std::size_t num_known : {1u, 3u, 40u}) {
                SCOPED_TRACE(testing::Message() << dimension << "-D, " << num_parts << " parts, "
                                                << num_known << " of them known");
                run(Case(dimension, num_parts, num_known, engine), engine);
            }
}

/// The Error of a look-up names what to call.
template <class LookUp>
void expect_unknown(LookUp&& look_up) {
    try {
        look_up();
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
        EXPECT_NE(std::string(error.what()).find("assign_all(cuts, points, comm)"),
                  std::string::npos);
        EXPECT_NE(std::string(error.what()).find("gather_cuts(cuts, comm)"), std::string::npos);
    }
}

TEST(PartialCuts, tell_the_part_of_a_position_whose_path_is_known) {
    std::size_t num_known = 0;
    std::size_t num_unknown = 0;
    for_each_case([&](const Case& data, std::mt19937_64&) {
        for (LocalIndex i = 0; i < data.points.count; ++i) {
            const Vector x = data.points.position(i);
            const Part expected = part_of(data.whole, x);
            const bool is_known = knows(data.some, expected);
            EXPECT_EQ(part_of(data.some, x), is_known ? expected : no_part);
            ++(is_known ? num_known : num_unknown);
        }
    });
    EXPECT_GT(num_known, 1000u);
    EXPECT_GT(num_unknown, 1000u);
}

TEST(PartialCuts, assign_points_whose_paths_are_known_and_refuse_others) {
    for_each_case([](const Case& data, std::mt19937_64&) {
        std::vector<double> known;
        std::vector<Part> expected;
        for (LocalIndex i = 0; i < data.points.count; ++i) {
            const Vector x = data.points.position(i);
            const Part part = part_of(data.whole, x);
            if (!knows(data.some, part)) continue;
            known.insert(known.end(), x.begin(), x.begin() + data.points.dimension);
            expected.push_back(part);
        }
        std::vector<Part> parts(expected.size());
        assign(data.some, interleaved_points(known, data.points.dimension), parts);
        EXPECT_EQ(parts, expected);
        parts.resize(data.points.count);
        if (expected.size() < data.points.count)
            expect_unknown([&] { assign(data.some, data.points, parts); });
    });
}

TEST(PartialCuts, count_what_each_known_part_holds_and_what_is_below_each_unknown_node) {
    for_each_case([](const Case& data, std::mt19937_64&) {
        std::map<Part, std::pair<double, double>> expected;
        std::vector<Part> parts(data.points.count);
        const KnownTotals totals = assign_and_count(data.some, data.points, parts);
        for (LocalIndex i = 0; i < data.points.count; ++i) {
            const Part whole = part_of(data.whole, data.points.position(i));
            Part part = whole;
            if (!knows(data.some, whole)) {
                for (const std::int32_t node : test::path_to(whole, data.whole.num_parts, {}))
                    if (!std::ranges::binary_search(data.some.nodes, node)) {
                        part = -1 - node;
                        break;
                    }
            }
            ASSERT_EQ(parts[i], part) << "point " << i;
            expected[part].first += data.points.weight(i);
            expected[part].second += 1;
        }
        EXPECT_TRUE(totals.all_finite);
        std::map<Part, std::pair<double, double>> found;
        for (std::size_t k = 0; k < totals.parts.size(); ++k) {
            if (totals.counts[k] == 0) continue;
            EXPECT_FALSE(found.contains(totals.parts[k]));
            found[totals.parts[k]] = {totals.weights[k], totals.counts[k]};
        }
        ASSERT_EQ(found.size(), expected.size());
        for (const auto& [part, sums] : expected) {
            EXPECT_NEAR(found[part].first, sums.first, 1e-12 * sums.first);
            EXPECT_EQ(found[part].second, sums.second);
        }
    });
}

TEST(PartialCuts, notice_coordinates_that_are_not_finite) {
    std::mt19937_64 engine(8);
    Case data(2, 40, 5, engine);
    for (const double bad : {infinity, -infinity, std::nan("")}) {
        std::vector<double> coordinates = data.coordinates;
        coordinates[777] = bad;
        const Points points = interleaved_points(coordinates, 2);
        std::vector<Part> parts(points.count);
        EXPECT_FALSE(assign_and_count(data.some, points, parts).all_finite);
    }
}

TEST(PartialCuts, tell_the_boxes_of_known_parts) {
    for_each_case([](const Case& data, std::mt19937_64&) {
        for (Part part = 0; part < data.whole.num_parts; ++part) {
            if (!knows(data.some, part)) {
                expect_unknown([&] { box_of(data.some, part); });
                continue;
            }
            const Box box = box_of(data.some, part);
            const Box expected = box_of(data.whole, part);
            EXPECT_EQ(box.lower, expected.lower);
            EXPECT_EQ(box.upper, expected.upper);
        }
    });
}

TEST(PartialCuts, tell_the_parts_that_a_box_touches_where_all_of_them_are_known) {
    std::size_t num_told = 0;
    std::size_t num_refused = 0;
    for_each_case([&](const Case& data, std::mt19937_64& engine) {
        for (int round = 0; round < 40; ++round) {
            const Vector x = data.points.position(engine() % data.points.count);
            Box box{x, x};
            for (double& upper : box.upper) upper += static_cast<double>(engine() % 4) / 2;
            const std::vector<Part> touched = parts_touching(data.whole, box);
            const bool is_told =
                std::ranges::all_of(touched, [&](Part part) { return knows(data.some, part); });
            if (is_told) {
                EXPECT_EQ(parts_touching(data.some, box), touched);
            } else {
                expect_unknown([&] { parts_touching(data.some, box); });
            }
            ++(is_told ? num_told : num_refused);
        }
    });
    EXPECT_GT(num_told, 50u);
    EXPECT_GT(num_refused, 50u);
}

TEST(PartialCuts, that_know_nothing_tell_nothing) {
    Cuts cuts{2, 8, {Cut{}}, {3}};
    EXPECT_EQ(part_of(cuts, {}), no_part);
    const std::vector<double> x(4);
    std::vector<Part> parts(2);
    assign_and_count(cuts, interleaved_points(x, 2), parts);
    EXPECT_EQ(parts, std::vector<Part>(2, unknown_below(0)));
}

TEST(PartialCuts, of_all_cuts_work_as_the_whole) {
    std::mt19937_64 engine(9);
    Case data(3, 20, 1, engine);
    data.some.nodes.clear();
    for (std::int32_t node = 0; node < 19; ++node) data.some.nodes.push_back(node);
    data.some.tree = data.whole.tree;
    std::vector<Part> parts(data.points.count);
    std::vector<Part> expected(data.points.count);
    assign(data.some, data.points, parts);
    assign(data.whole, data.points, expected);
    EXPECT_EQ(parts, expected);
}

}  // namespace
}  // namespace rrcb
