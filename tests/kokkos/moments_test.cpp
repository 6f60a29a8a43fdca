#include "../unit/moments_reference.hpp"
#include "views.hpp"

namespace rrcb::test {
namespace {

/// Compares the moments of cells with sums in long double: to within 1e-6 of the sides.
void expect_reference(const Cloud& cloud, const SupportMesh& mesh,
                      const std::vector<CellMoments>& cells, double tolerance = 1e-6) {
    std::map<LocalIndex, std::vector<LocalIndex>> members;
    for (LocalIndex i = 0; i < cloud.count(); ++i)
        members[cell_of(mesh, cloud.points().position(i))].push_back(i);
    std::erase_if(members, [&](const auto& cell) {
        return !(reference_moments(cloud.points(), cell.second).weight > 0);
    });
    ASSERT_EQ(cells.size(), members.size());
    auto member = members.begin();
    for (const CellMoments& cell : cells) {
        ASSERT_EQ(cell.cell, member->first);
        EXPECT_EQ(cell.moments.count, std::ssize(member->second));
        const ReferenceMoments reference = reference_moments(cloud.points(), member->second);
        const auto weight = static_cast<double>(reference.weight);
        EXPECT_NEAR(cell.moments.weight, weight, 1e-12 * weight);
        for (std::size_t a = 0; a < static_cast<std::size_t>(cloud.dimension); ++a) {
            const double side = cell.box.upper[a] / 2 - cell.box.lower[a] / 2;
            EXPECT_NEAR(cell.moments.mean[a] / 2, static_cast<double>(reference.mean[a]) / 2,
                        tolerance * side);
            EXPECT_NEAR(cell.moments.deviation[a], static_cast<double>(reference.deviation[a]),
                        2 * tolerance * side);
        }
        ++member;
    }
}

void expect_equal(const std::vector<CellMoments>& a, const std::vector<CellMoments>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_EQ(a[k].cell, b[k].cell);
        EXPECT_EQ(a[k].moments.count, b[k].moments.count);
        EXPECT_EQ(a[k].moments.weight, b[k].moments.weight);
        EXPECT_EQ(a[k].moments.mean, b[k].moments.mean);
        EXPECT_EQ(a[k].moments.deviation, b[k].moments.deviation);
    }
}

SupportMesh mesh_of(const Cloud& cloud, int cells) {
    return make_support_mesh(bounding_box(cloud.points()), cloud.dimension, cells);
}

TEST(Moments, are_those_of_long_double) {
    for (const int dimension : {1, 2, 3})
        for (const bool is_weighted : {false, true}) {
            const Cloud cloud = smooth_cloud(40000, dimension, 11, is_weighted);
            const SupportMesh mesh = mesh_of(cloud, 6);
            expect_reference(cloud, mesh,
                             passes_of<double, Kokkos::LayoutLeft>(cloud).moments(mesh));
            expect_reference(cloud, mesh,
                             passes_of<float, Kokkos::LayoutRight>(cloud).moments(mesh));
        }
}

TEST(Moments, are_the_same_in_any_order_and_layout) {
    const Cloud cloud = smooth_cloud(70000, 2, 11, true);
    Cloud reversed = cloud;
    std::ranges::reverse(reversed.weights);
    for (std::size_t i = 0; i < cloud.count(); ++i)
        std::copy_n(&cloud.x[2 * i], 2, &reversed.x[2 * (cloud.count() - 1 - i)]);
    const SupportMesh mesh = mesh_of(cloud, 9);
    const auto cells = passes_of<double, Kokkos::LayoutLeft>(cloud).moments(mesh);
    expect_equal(passes_of<double, Kokkos::LayoutRight>(reversed).moments(mesh), cells);
    expect_equal(passes_of<float, Kokkos::LayoutStride>(reversed).moments(mesh), cells);
}

TEST(Moments, of_many_cells_do_without_scratch) {
    const Cloud cloud = smooth_cloud(20000, 2, 11, true);
    const SupportMesh mesh = mesh_of(cloud, 1100);
    ASSERT_LT(detail::bins_in_scratch(Device()), static_cast<std::int64_t>(3 * num_cells(mesh)));
    expect_reference(cloud, mesh, passes_of<double, Kokkos::LayoutLeft>(cloud).moments(mesh));
}

TEST(Moments, of_coincident_points_have_no_deviation) {
    Cloud cloud{3, {}};
    for (int i = 0; i < 90000; ++i)
        cloud.x.insert(cloud.x.end(), {0.3 + i % 2, 1e5 + i % 3, i % 5 == 0 ? 0.7 : 1e-9});
    const SupportMesh mesh = mesh_of(cloud, 10);
    const auto cells = passes_of<double, Kokkos::LayoutLeft>(cloud).moments(mesh);
    expect_reference(cloud, mesh, cells);
    Cloud one{2, std::vector<double>(2000, 0.125)};
    const auto same = passes_of<double, Kokkos::LayoutLeft>(one).moments(mesh_of(one, 10));
    ASSERT_EQ(same.size(), 1u);
    EXPECT_EQ(same[0].moments.mean, (Vector{0.125, 0.125, 0}));
    EXPECT_EQ(same[0].moments.deviation, Vector{});
}

TEST(Moments, hold_extreme_lengths_and_weights) {
    for (const double length : {1e-300, 1e307})
        for (const double weight : {1e-310, 1.0, 1e300}) {
            Cloud cloud{2, uniform_cloud(3000, 2, 5)};
            for (double& x : cloud.x) x = (x - 0.5) * length;
            for (int i = 0; i < 3000; ++i) cloud.weights.push_back(weight * (1 + i % 3));
            const SupportMesh mesh = mesh_of(cloud, 5);
            auto passes = passes_of<double, Kokkos::LayoutLeft>(cloud);
            expect_reference(cloud, mesh, passes.moments(mesh));
        }
}

TEST(Moments, reach_from_the_frame_to_the_box) {
    Cloud cloud = smooth_cloud(5000, 1, 5, false);
    cloud.x[0] = -50;
    cloud.x[9] = 1000;
    SupportMesh mesh = mesh_of(cloud, 8);
    mesh.frame.lower[0] = 2.5;
    mesh.frame.upper[0] = 4.5;
    mesh.cells_per_length[0] = 4;
    expect_reference(cloud, mesh, passes_of<double, Kokkos::LayoutLeft>(cloud).moments(mesh));
}

/// What 32 threads of a GPU do that add the points of a block to bins.
struct Meetings {
    double additions = 0;  ///< of a bin, for each point
    double threads = 0;    ///< that add to one bin at a time: mean over additions
};

Meetings meetings_of(const std::vector<int>& bins, bool adds_runs) {
    constexpr int width = 32;
    const int run = adds_runs ? detail::run_length : 1;
    std::array<int, width> last;
    last.fill(-1);
    double additions = 0;
    double threads = 0;
    for (std::size_t k = 0; k + width * run <= bins.size(); k += width * run)
        for (int step = 0; step < run; ++step) {
            std::map<int, int> adding;
            for (std::size_t t = 0; t < width; ++t) {
                const int bin = bins[k + t * run + step];
                if (!adds_runs) ++adding[bin];
                if (adds_runs && last[t] >= 0 && last[t] != bin) ++adding[last[t]];
                last[t] = bin;
            }
            for (const auto& [bin, number] : adding) {
                additions += number;
                threads += number * number;
            }
        }
    return {additions / static_cast<double>(bins.size()), threads / std::max(additions, 1.0)};
}

TEST(Meetings, are_few_in_any_order_of_the_points) {
    constexpr std::size_t count = 1 << 17;
    const auto bins_of = [](double scale, auto place) {
        std::vector<int> bins;
        for (std::size_t i = 0; i < count; ++i)
            bins.push_back(static_cast<int>(scale * place(static_cast<double>(i) / count)));
        return bins;
    };
    std::mt19937_64 engine(1);
    const auto random = bins_of(1000, [&](double) { return uniform(engine); });
    const auto sorted = bins_of(1000, [](double x) { return x; });
    const auto parts = bins_of(8, [](double x) { return x; });
    const auto few = bins_of(8, [&](double) { return uniform(engine); });
    // Rows of a lattice, each through 10 cells.
    const auto rows = bins_of(10, [](double x) { return std::fmod(x * 2500, 1); });
    const auto clustered = bins_of(1000, [&](double) { return std::pow(uniform(engine), 30); });
    const auto cost = [](const std::vector<int>& bins, bool adds_runs) {
        const Meetings found = meetings_of(bins, adds_runs);
        return found.additions * found.threads;
    };
    EXPECT_NEAR(cost(random, false), 1.03, 0.01);
    EXPECT_NEAR(cost(sorted, false), 29, 1);
    EXPECT_LT(cost(random, true), 1.04);
    EXPECT_LT(cost(sorted, true), 0.2 * cost(sorted, false));
    EXPECT_NEAR(cost(few, false), 1 + 31.0 / 8, 0.01);
    EXPECT_LT(cost(few, true), 0.8 * cost(few, false));
    EXPECT_LT(cost(parts, true), 0.01 * cost(parts, false));
    EXPECT_LT(cost(rows, true), 0.25 * cost(rows, false));
    EXPECT_LT(cost(clustered, true), 0.5 * cost(clustered, false));
}

TEST(Moments, without_weight_are_those_of_the_number) {
    Cloud cloud = smooth_cloud(500, 2, 5, false);
    const SupportMesh mesh = mesh_of(cloud, 4);
    auto expected = passes_of<double, Kokkos::LayoutLeft>(cloud).moments(mesh);
    for (CellMoments& cell : expected) cell.moments.weight = 0;
    cloud.weights.assign(500, 0);
    expect_equal(passes_of<double, Kokkos::LayoutLeft>(cloud).moments(mesh), expected);
}

}  // namespace
}  // namespace rrcb::test
