#include "ranks.hpp"
#include "same_error.hpp"
#include "views.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/experimental/kokkos.hpp>

#include <string_view>

namespace rrcb::test {
namespace {

/// Points of this rank: none on the last of several; some coincident, many aligned.
Cloud cloud_of_rank(int dimension, bool is_weighted, bool is_lattice) {
    const std::size_t count =
        num_ranks() > 1 && is_last_rank() ? 0 : 800 + 200 * static_cast<std::size_t>(rank());
    const unsigned seed = 10 + static_cast<unsigned>(rank());
    return is_lattice ? lattice_cloud(count, dimension, seed, is_weighted)
                      : smooth_cloud(count, dimension, seed, is_weighted);
}

template <class T, class Layout>
auto balance_views(const Cloud& cloud, const Options& options, const Cuts& previous) {
    return experimental::balance(Device(), view_of<T, Layout>(cloud), on_device(cloud.weights),
                                 MPI_COMM_WORLD, options, previous);
}

void expect_same_cuts(const Cuts& cuts, const Cuts& expected) {
    ASSERT_EQ(cuts.tree.size(), expected.tree.size());
    for (std::size_t k = 0; k < cuts.tree.size(); ++k) {
        EXPECT_EQ(cuts.tree[k].axis, expected.tree[k].axis);
        EXPECT_EQ(cuts.tree[k].divides, expected.tree[k].divides);
        EXPECT_EQ(cuts.tree[k].at, expected.tree[k].at);
    }
}

template <class T, class Layout>
void expect_exact_cuts_of_the_host(const Cloud& cloud, Coincident coincident) {
    Options options{.num_parts = 7, .refine = Refine::exact, .expert = {.coincident = coincident}};
    const Balance expected = balance(cloud.points(), MPI_COMM_WORLD, options);
    std::vector<int> axes;
    for (const Cut& cut : expected.cuts.tree) axes.push_back(cut.axis);
    options.expert.axes.order = AxisOrder::given(axes);
    options.expert.tree = expected.cuts.shape;
    const auto found = balance_views<T, Layout>(cloud, options, {});
    expect_same_cuts(found.cuts, expected.cuts);
    EXPECT_EQ(on_host(found.parts), expected.parts);
    EXPECT_EQ(found.report.imbalance, expected.report.imbalance);
    EXPECT_EQ(found.report.part_weights, expected.report.part_weights);
}

TEST(KokkosBalance, has_the_exact_cuts_of_the_host) {
    for (const bool is_weighted : {false, true})
        for (const bool is_lattice : {false, true}) {
            using Kokkos::LayoutLeft, Kokkos::LayoutRight;
            const auto cloud = [&](int d) { return cloud_of_rank(d, is_weighted, is_lattice); };
            const auto together = Coincident::together;
            expect_exact_cuts_of_the_host<double, LayoutLeft>(cloud(1), together);
            expect_exact_cuts_of_the_host<double, LayoutLeft>(cloud(2), Coincident::divide);
            expect_exact_cuts_of_the_host<float, LayoutRight>(cloud(2), together);
            expect_exact_cuts_of_the_host<double, LayoutRight>(cloud(3), together);
        }
}

TEST(KokkosBalance, is_within_the_tolerance_and_repeats_its_bits) {
    for (const int dimension : {1, 2, 3}) {
        const Cloud cloud = cloud_of_rank(dimension, dimension == 2, false);
        const auto first = balance_views<double, Kokkos::LayoutLeft>(cloud, {.num_parts = 6}, {});
        const auto again = balance_views<float, Kokkos::LayoutRight>(cloud, {.num_parts = 6}, {});
        EXPECT_TRUE(first.report.within_tolerance) << first.report.imbalance;
        expect_same_cuts(again.cuts, first.cuts);
        EXPECT_EQ(on_host(again.parts), on_host(first.parts));
        std::vector<Part> parts(cloud.count());
        assign(first.cuts, cloud.points(), parts);
        EXPECT_EQ(on_host(first.parts), parts);
    }
}

TEST(KokkosBalance, begins_with_earlier_cuts) {
    Cloud cloud = cloud_of_rank(2, true, false);
    auto found = balance_views<double, Kokkos::LayoutLeft>(cloud, {}, {});
    const auto kept = balance_views<double, Kokkos::LayoutLeft>(cloud, {}, found.cuts);
    expect_same_cuts(kept.cuts, found.cuts);
    EXPECT_EQ(on_host(kept.parts), on_host(found.parts));
    for (int step = 0; step < 4; ++step) {
        for (double& x : cloud.x) x *= 1 + 0.02 * x;
        const auto next = balance_views<double, Kokkos::LayoutLeft>(cloud, {}, found.cuts);
        EXPECT_TRUE(next.report.within_tolerance) << next.report.imbalance;
        std::vector<Part> parts(cloud.count());
        assign(next.cuts, cloud.points(), parts);
        EXPECT_EQ(on_host(next.parts), parts);
        found.cuts = next.cuts;
    }
}

TEST(KokkosBalance, reuses_its_memory) {
    const Cloud cloud = cloud_of_rank(2, true, false);
    const auto x = view_of<double, Kokkos::LayoutLeft>(cloud);
    const auto weights = on_device(cloud.weights);
    const auto expected = experimental::balance(Device(), x, weights, MPI_COMM_WORLD);
    const std::vector<Part> expected_parts = on_host(expected.parts);
    auto found = expected;
    const Part* const parts = found.parts.data();
    for (const Cuts& previous : {Cuts{}, expected.cuts}) {
        experimental::balance_into(found, Device(), x, weights, MPI_COMM_WORLD, Options{},
                                   previous);
        expect_same_cuts(found.cuts, expected.cuts);
        EXPECT_EQ(on_host(found.parts), expected_parts);
        EXPECT_EQ(found.parts.data(), parts);
    }
    // Fewer points, in the same memory.
    const std::pair<std::size_t, std::size_t> half(0, cloud.count() / 2);
    const auto fewer = Kokkos::subview(x, half, Kokkos::ALL);
    const auto lighter = Kokkos::subview(weights, half);
    const auto of_fewer = experimental::balance(Device(), fewer, lighter, MPI_COMM_WORLD);
    experimental::balance_into(found, Device(), fewer, lighter, MPI_COMM_WORLD);
    EXPECT_EQ(on_host(found.parts), on_host(of_fewer.parts));
    EXPECT_EQ(found.parts.data(), parts);
}

TEST(KokkosBalance, reads_points_without_weights) {
    const Cloud cloud = cloud_of_rank(3, false, false);
    const auto x = view_of<double, Kokkos::LayoutLeft>(cloud);
    const auto found = experimental::balance(Device(), x, MPI_COMM_WORLD);
    const auto axis = [&](int a) { return Kokkos::subview(x, Kokkos::ALL, a); };
    const auto of_axes =
        experimental::balance(Device(), std::array{axis(0), axis(1), axis(2)}, MPI_COMM_WORLD);
    expect_same_cuts(of_axes.cuts, found.cuts);
}

TEST(KokkosBalance, throws_the_error_of_one_rank_on_all) {
    const Cloud good = cloud_of_rank(2, true, false);
    Cloud bad = good;
    if (rank() == 0) bad.x[40] = std::nan("");
    expect_same_error([&] { balance_views<double, Kokkos::LayoutLeft>(bad, {}, {}); },
                      "coordinate of point 20 on axis 0 is NaN or infinite");
    bad = good;
    if (rank() == 0) bad.weights[7] = -1;
    expect_same_error([&] { balance_views<double, Kokkos::LayoutLeft>(bad, {}, {}); },
                      "weight of point 7 is negative, NaN or infinite (1 such value on this rank)");
    if (rank() == 0) bad.weights.pop_back();
    expect_same_error([&] { balance_views<double, Kokkos::LayoutLeft>(bad, {}, {}); },
                      "weights must hold one entry per point");
    if (num_ranks() == 1) return;
    const Options options{.imbalance_tolerance = rank() == 0 ? 1.1 : 1.2};
    expect_same_error([&] { balance_views<double, Kokkos::LayoutLeft>(good, options, {}); },
                      "imbalance_tolerance");
}

/// Copies and fences of a call, as Kokkos reports them: fences since version 4.
struct Traffic {
    std::uint64_t bytes = 0;
    int copies = 0;
    int fences = 0;        ///< of the instance that was passed
    int other_fences = 0;  ///< to return a value, or to free memory
};
Traffic traffic;

void add_copy(Kokkos::Tools::SpaceHandle, const char*, const void*, Kokkos::Tools::SpaceHandle,
              const char* source, const void*, std::uint64_t size) {
    if (std::string_view(source) == "(none)") return;  // a number that fills a view
    traffic.bytes += size;
    ++traffic.copies;
}

void add_fence(const char* name, std::uint32_t, std::uint64_t*) {
    const bool is_unnamed = std::string_view(name).find("Unnamed") != std::string_view::npos;
    ++(is_unnamed ? traffic.fences : traffic.other_fences);
}

template <class Call>
Traffic traffic_of(const Call& call) {
    namespace tools = Kokkos::Tools::Experimental;
    traffic = {};
    tools::set_begin_deep_copy_callback(add_copy);
    tools::set_begin_fence_callback(add_fence);
    call();
    tools::set_begin_deep_copy_callback(nullptr);
    tools::set_begin_fence_callback(nullptr);
    return traffic;
}

TEST(KokkosBalance, copies_little_and_rarely_waits) {
    for (const bool is_weighted : {false, true}) {
        Cloud cloud = smooth_cloud(200000, 3, 10 + static_cast<unsigned>(rank()), is_weighted);
        cloud.x = uniform_cloud(200000, 3, 10 + static_cast<unsigned>(rank()));  // no ties
        const auto x = view_of<double, Kokkos::LayoutLeft>(cloud);
        const auto weights = on_device(cloud.weights);
        const auto traffic_to = [&](Refine refine) {
            const Options options{.num_parts = 8, .refine = refine};
            return traffic_of(
                [&] { experimental::balance(Device(), x, weights, MPI_COMM_WORLD, options); });
        };
        // Of the steps ends, sample, moments and parts, parts copy twice to the device. Weights add
        // a sum.
        const int steps = 4;
        const int sums = is_weighted ? 1 : 0;
        const Traffic tolerant = traffic_to(Refine::tolerance);
        EXPECT_GT(tolerant.bytes, 0u);
        EXPECT_LT(tolerant.bytes, 60000u);
        EXPECT_EQ(tolerant.copies, steps + sums + 5);
        // Open points are counted with the parts, then copied and settled: 52 or 60 bytes for each.
        const Traffic exact = traffic_to(Refine::exact);
        EXPECT_LT(exact.bytes, is_weighted ? 1100000u : 1000000u);
        EXPECT_EQ(exact.copies, steps + sums + 8);
        // Older versions do not report fences.
        const bool has_fences = KOKKOS_VERSION >= 40000;
        EXPECT_EQ(tolerant.fences, has_fences ? steps + sums : 0);
        EXPECT_EQ(exact.fences, has_fences ? steps + sums + 2 : 0);
        // Bounds are returned as a value.
        EXPECT_LE(tolerant.other_fences, 3);
        EXPECT_LE(exact.other_fences, 4);
    }
}

TEST(KokkosBalance, of_no_points_is_empty) {
    const Cloud cloud{2};
    const auto found = balance_views<double, Kokkos::LayoutLeft>(cloud, {.num_parts = 3}, {});
    EXPECT_EQ(found.report.details.num_points, 0);
    EXPECT_EQ(found.parts.extent(0), 0u);
}

}  // namespace
}  // namespace rrcb::test
