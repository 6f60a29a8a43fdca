#include "views.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <thread>

namespace rrcb::test {
namespace {

template <class T, class L, int Dimension>
struct Kind {
    using Scalar = T;
    using Layout = L;
    static constexpr int dimension = Dimension;
};

template <class K>
class Passes : public testing::Test {
  public:
    static auto passes(const Cloud& cloud) {
        return passes_of<typename K::Scalar, typename K::Layout>(cloud);
    }
    static Cloud lattice(std::size_t count, bool is_weighted = false) {
        return lattice_cloud(count, K::dimension, 7, is_weighted);
    }
};

using Kinds =
    testing::Types<Kind<double, Kokkos::LayoutLeft, 1>, Kind<float, Kokkos::LayoutLeft, 2>,
                   Kind<double, Kokkos::LayoutRight, 2>, Kind<double, Kokkos::LayoutStride, 3>,
                   Kind<float, Kokkos::LayoutRight, 3>>;
TYPED_TEST_SUITE(Passes, Kinds);

/// Returns the totals of points in each part.
PartTotals totals_of(const Cloud& cloud, const std::vector<Part>& parts, int num_parts) {
    PartTotals totals{std::vector<double>(num_parts), std::vector<double>(num_parts)};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i] < 0) continue;
        totals.counts[parts[i]] += 1;
        totals.weights[parts[i]] += cloud.points().weight(i);
    }
    return totals;
}

std::vector<Part> parts_on_host(const Cuts& cuts, const Cloud& cloud) {
    std::vector<Part> parts(cloud.count());
    assign(cuts, cloud.points(), parts);
    return parts;
}

TYPED_TEST(Passes, summarize_the_points) {
    for (const bool is_weighted : {false, true}) {
        const Cloud cloud = this->lattice(3000, is_weighted);
        auto passes = this->passes(cloud);
        ASSERT_EQ(passes.dimension(), TypeParam::dimension);
        const PointSummary summary = passes.summary(true);
        EXPECT_EQ(summary.count, 3000u);
        double weight = 0;
        for (std::size_t i = 0; i < cloud.count(); ++i) weight += cloud.points().weight(i);
        EXPECT_EQ(summary.weight, weight);
        EXPECT_EQ(summary.lightest, is_weighted ? 0 : 1);
        EXPECT_EQ(summary.heaviest, 1);
        for (int axis = 0; axis < TypeParam::dimension; ++axis) {
            std::vector<Vector> sorted;
            for (std::size_t i = 0; i < cloud.count(); ++i) {
                Vector x = cloud.points().position(i);
                std::rotate(x.begin(), x.begin() + axis, x.begin() + axis + 1);
                sorted.push_back(x);
            }
            std::ranges::sort(sorted);
            const auto a = static_cast<std::size_t>(axis);
            EXPECT_EQ(summary.box.lower[a], sorted.front()[0]);
            EXPECT_EQ(summary.box.upper[a], sorted.back()[0]);
            for (Vector* x : {&sorted.front(), &sorted.back()})
                std::rotate(x->begin(), x->begin() + 1, x->begin() + axis + 1);
            EXPECT_EQ(summary.first[a], sorted.front());
            EXPECT_EQ(summary.last[a], sorted.back());
        }
        EXPECT_EQ(passes.summary(false).box.lower[0], std::numeric_limits<double>::infinity());
    }
}

TYPED_TEST(Passes, assign_and_count_as_the_host) {
    for (const int num_parts : {1, 2, 7, 900}) {
        const Cloud cloud = this->lattice(2000, num_parts == 7);
        auto passes = this->passes(cloud);
        const Cuts cuts = cuts_through(cloud, num_parts, 3);
        const PartTotals totals = passes.assign(cuts, true);
        const std::vector<Part> expected = parts_on_host(cuts, cloud);
        EXPECT_EQ(passes.parts(), expected);
        EXPECT_EQ(totals.counts, totals_of(cloud, expected, num_parts).counts);
        EXPECT_EQ(totals.weights, totals_of(cloud, expected, num_parts).weights);
        EXPECT_TRUE(passes.assign(cuts, false).counts.empty());
    }
}

/// Returns the part that a point has wherever the cuts are in their intervals, or no_part.
Part settled_part(const Cuts& cuts, const std::vector<Bracket>& intervals, const Vector& x) {
    std::size_t node = 0;
    Part part = 0;
    for (int num_parts = cuts.num_parts; num_parts > 1;) {
        const double value = x[static_cast<std::size_t>(cuts.tree[node].axis)];
        if (value >= intervals[node].lower && value < intervals[node].upper) return no_part;
        const int lower = cuts.shape.lower_parts(num_parts);
        const bool is_above = value >= intervals[node].upper;
        node += is_above ? static_cast<std::size_t>(lower) : 1;
        part += is_above ? lower : 0;
        num_parts = is_above ? num_parts - lower : lower;
    }
    return part;
}

struct CollectCase {
    Cloud cloud;
    Cuts cuts;
    std::vector<Bracket> intervals{};
    std::vector<Part> settled{};

    CollectCase(Cloud points, int num_parts)
        : cloud(std::move(points)), cuts(cuts_through(cloud, num_parts, 5)) {
        for (const Cut& cut : cuts.tree) {
            const double x = cut.at[static_cast<std::size_t>(cut.axis)];
            intervals.push_back({x - 0.05, x + 0.05});
        }
        for (std::size_t i = 0; i < cloud.count(); ++i)
            settled.push_back(settled_part(cuts, intervals, cloud.points().position(i)));
    }
    std::vector<LocalIndex> open() const {
        std::vector<LocalIndex> indices;
        for (std::size_t i = 0; i < settled.size(); ++i)
            if (settled[i] < 0) indices.push_back(i);
        return indices;
    }
};

void expect_copies(const Cloud& cloud, const Collected& collected) {
    for (LocalIndex k = 0; k < collected.count(); ++k) {
        EXPECT_EQ(collected.position(k), cloud.points().position(collected.original[k]));
        EXPECT_EQ(collected.weight(k), cloud.points().weight(collected.original[k]));
    }
}

std::vector<LocalIndex> indices_of(const Collected& collected) {
    return {collected.original.begin(), collected.original.end()};
}

TYPED_TEST(Passes, collect_open_points_in_order) {
    for (const bool has_parts : {false, true}) {
        const CollectCase test(this->lattice(2500, has_parts), 6);
        auto passes = this->passes(test.cloud);
        if (has_parts) passes.assign(test.cuts, false);
        Collected collected;
        passes.collect(test.cuts, test.intervals, has_parts, collected);
        EXPECT_EQ(passes.parts(), test.settled);
        EXPECT_EQ(indices_of(collected), test.open());
        expect_copies(test.cloud, collected);
        const PartTotals totals = totals_of(test.cloud, test.settled, 6);
        EXPECT_EQ(collected.settled.counts, totals.counts);
        EXPECT_EQ(collected.settled.weights, totals.weights);

        const std::vector<Part> parts(collected.count(), 4);
        passes.settle(collected, parts);
        for (const LocalIndex i : collected.original) EXPECT_EQ(passes.parts()[i], 4);
    }
}

TYPED_TEST(Passes, collect_more_points_of_a_node) {
    const CollectCase test(this->lattice(2500, true), 6);
    auto passes = this->passes(test.cloud);
    Collected collected;
    passes.collect(test.cuts, test.intervals, false, collected);
    const LocalIndex before = collected.count();
    const std::vector<Wanted> wanted{{0, 2, 0, {-1, 0}}, {3, 3, TypeParam::dimension - 1, {0, 1}}};
    const std::vector<std::size_t> nodes = passes.collect_more(wanted, collected);
    std::vector<Part> left = test.settled;
    LocalIndex k = before;
    for (std::size_t i = 0; i < left.size(); ++i) {
        const std::size_t node = left[i] < 2 ? 0 : 1;
        if (left[i] < 0 || left[i] == 2) continue;
        if (!wanted[node].contains(test.cloud.points().position(i)[wanted[node].axis])) continue;
        left[i] = no_part;
        ASSERT_LT(k, collected.count());
        EXPECT_EQ(collected.original[k], i);
        EXPECT_EQ(nodes[k++ - before], node);
    }
    EXPECT_EQ(k, collected.count());
    EXPECT_EQ(passes.parts(), left);
    expect_copies(test.cloud, collected);
    EXPECT_EQ(collected.settled.counts, totals_of(test.cloud, left, 6).counts);
    EXPECT_EQ(collected.settled.weights, totals_of(test.cloud, left, 6).weights);
}

TYPED_TEST(Passes, find_boxes_and_renumber) {
    const CollectCase test(this->lattice(1500), 6);
    auto passes = this->passes(test.cloud);
    Collected collected;
    passes.collect(test.cuts, test.intervals, false, collected);
    std::vector<Box> boxes(6);
    for (std::size_t i = 0; i < test.settled.size(); ++i)
        for (int axis = 0; axis < TypeParam::dimension && test.settled[i] >= 0; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            Box& box = boxes[test.settled[i]];
            box.lower[a] = std::min(box.lower[a], test.cloud.points().position(i)[a]);
            box.upper[a] = std::max(box.upper[a], test.cloud.points().position(i)[a]);
        }
    const std::vector<Box> found = passes.boxes(6);
    for (std::size_t p = 0; p < 6; ++p) {
        EXPECT_EQ(found[p].lower, boxes[p].lower);
        EXPECT_EQ(found[p].upper, boxes[p].upper);
    }
    passes.assign(test.cuts, false);
    std::vector<Part> parts = passes.parts();
    const std::vector<Part> numbers{5, 4, 3, 2, 1, 0};
    passes.renumber(numbers);
    for (Part& part : parts) part = 5 - part;
    EXPECT_EQ(passes.parts(), parts);
    passes.renumber(std::vector<Part>{3});
    EXPECT_EQ(passes.parts(), std::vector<Part>(1500, 3));
    passes.set_parts(parts);
    EXPECT_EQ(passes.parts(), parts);
}

TYPED_TEST(Passes, sample_points_of_the_cloud) {
    const Cloud cloud = this->lattice(300, true);
    auto passes = this->passes(cloud);
    const PointSample all = passes.sample(300);
    const PointSample some = passes.sample(20);
    ASSERT_EQ(all.positions.size(), 300u);
    ASSERT_EQ(some.positions.size(), 20u);
    for (std::size_t i = 0; i < 300; ++i) {
        EXPECT_EQ(all.positions[i], cloud.points().position(i));
        EXPECT_EQ(all.weights[i], cloud.weights[i]);
    }
    EXPECT_EQ(some.positions, passes.sample(20).positions);
}

TYPED_TEST(Passes, do_nothing_without_points) {
    Cloud cloud = this->lattice(10);
    const Cuts cuts = cuts_through(cloud, 3, 1);
    cloud.x.clear();
    auto passes = this->passes(cloud);
    EXPECT_EQ(passes.dimension(), TypeParam::dimension);
    EXPECT_FALSE(passes.has_weights());
    EXPECT_EQ(passes.summary(true).count, 0u);
    EXPECT_TRUE(passes.sample(5).positions.empty());
    EXPECT_EQ(passes.assign(cuts, true).counts, std::vector<double>(3));
    Collected collected;
    passes.collect(cuts, std::vector<Bracket>(2), false, collected);
    EXPECT_EQ(collected.count(), 0u);
    EXPECT_TRUE(passes.parts().empty());
    EXPECT_EQ(passes.boxes(3).size(), 3u);
    passes.renumber(std::vector<Part>{0});
}

TYPED_TEST(Passes, name_the_first_bad_value_as_the_host) {
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        Cloud cloud = this->lattice(900, true);
        const Cuts cuts = cuts_through(cloud, 4, 1);
        cloud.x[600] = cloud.x[700] = bad;
        const auto host = [&] { parts_on_host(cuts, cloud); };
        auto passes = this->passes(cloud);
        EXPECT_EQ(error_of([&] { passes.summary(true); }), error_of(host));
        EXPECT_EQ(error_of([&] { passes.assign(cuts, false); }), error_of(host));
        cloud.weights[800] = cloud.weights[20] = bad;
        cloud.weights[21] = -1;
        const SupportMesh mesh = make_support_mesh({{0, 0, 0}, {1, 1, 1}}, TypeParam::dimension, 2);
        auto weighted = this->passes(cloud);
        EXPECT_EQ(error_of([&] { weighted.summary(true); }),
                  error_of([&] { cell_moments(cloud.points(), mesh); }));
        EXPECT_NE(error_of([&] { weighted.summary(false); }), "no error");
        weighted.use_weights(false);
        EXPECT_EQ(error_of([&] { weighted.summary(true); }), error_of(host));
        cloud.weights.assign(900, 1e308);
        EXPECT_EQ(error_of([&] { this->passes(cloud).summary(true); }),
                  error_of([&] { cell_moments(cloud.points(), mesh); }));
    }
}

TEST(Passes, read_a_view_of_each_axis) {
    const Cloud cloud = lattice_cloud(100, 2, 1, false);
    const auto view = view_of<double, Kokkos::LayoutRight>(cloud);
    const auto x = Kokkos::subview(view, Kokkos::ALL, 0);
    const auto y = Kokkos::subview(view, Kokkos::ALL, 1);
    using Axes = std::array<std::remove_const_t<decltype(x)>, 2>;
    detail::KokkosPasses<Device, Axes, WeightView> passes(Device(), Axes{x, y}, {});
    const PointSample sample = passes.sample(100);
    for (std::size_t i = 0; i < 100; ++i)
        EXPECT_EQ(sample.positions[i], cloud.points().position(i));
    const auto shorter = Kokkos::subview(x, std::pair<int, int>(0, 99));
    detail::KokkosPasses<Device, Axes, WeightView> uneven(Device(), Axes{x, shorter}, {});
    EXPECT_EQ(error_of([&] { uneven.summary(true); }),
              "coordinate arrays must all have the same length");
}

TEST(Passes, refuse_no_axes_and_four) {
    for (const int dimension : {0, 4}) {
        const Kokkos::View<double**, Memory> x("x", 10, dimension);
        detail::KokkosPasses<Device, Kokkos::View<double**, Memory>, WeightView> passes(Device(), x,
                                                                                        {});
        EXPECT_EQ(error_of([&] { passes.summary(true); }),
                  "positions have 1 to 3 axes, not " + std::to_string(dimension));
    }
}

TEST(Passes, of_two_threads_do_not_disturb_each_other) {
    const Cloud cloud = smooth_cloud(40000, 3, 5, true);
    const Cuts cuts = cuts_through(cloud, 40, 2);
    const auto expected = passes_of<double, Kokkos::LayoutLeft>(cloud).assign(cuts, true);
    const auto repeat = [&](auto passes, int& num_equal) {
        for (int k = 0; k < 30; ++k) {
            num_equal += passes.assign(cuts, true).weights == expected.weights;
            passes.summary(true);
        }
    };
    std::array<int, 2> num_equal{};
    std::thread other(repeat, passes_of<double, Kokkos::LayoutLeft>(cloud), std::ref(num_equal[0]));
    repeat(passes_of<double, Kokkos::LayoutLeft>(cloud), num_equal[1]);
    other.join();
    EXPECT_EQ(num_equal, (std::array{30, 30}));
}

TEST(Passes, refuse_weights_of_another_length) {
    Cloud cloud = lattice_cloud(100, 2, 1, true);
    cloud.weights.pop_back();
    auto passes = passes_of<double, Kokkos::LayoutLeft>(cloud);
    EXPECT_EQ(error_of([&] { passes.summary(true); }),
              "weights must hold one entry per point, or none for unit weights");
}

}  // namespace
}  // namespace rrcb::test
