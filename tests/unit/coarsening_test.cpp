#include "../support/common.hpp"
#include "estimate/cell_records.hpp"

namespace rrcb {
namespace {

/// A cell of one point of weight 1.
CellMoments point_at(double x, double y) {
    return {0, {{x, y, 0}, {x, y, 0}}, {1, 1.0, {x, y, 0}, {}}};
}

CellSet uniform_points(std::size_t count, unsigned seed, double offset = 0, double extent = 1) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> inside(offset, offset + extent);
    CellSet set;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = inside(engine);
        set.cells.push_back(point_at(x, inside(engine)));
    }
    return set;
}

/// Moments of all cells together, in long double.
Moments total_of(const CellSet& set) {
    Moments total;
    long double weight = 0;
    long double first[2] = {0, 0};
    for (const CellMoments& cell : set.cells) {
        total.count += cell.moments.count;
        weight += cell.moments.weight;
        for (int a = 0; a < 2; ++a)
            first[a] += static_cast<long double>(cell.moments.weight) * cell.moments.mean[a];
    }
    for (std::size_t a = 0; a < 2; ++a) {
        const long double mean = first[a] / weight;
        long double second = 0;
        for (const CellMoments& cell : set.cells) {
            const long double distance = cell.moments.mean[a] - mean;
            const long double deviation = cell.moments.deviation[a];
            second += cell.moments.weight * (distance * distance + deviation * deviation);
        }
        total.mean[a] = static_cast<double>(mean);
        total.deviation[a] = static_cast<double>(std::sqrt(second / weight));
    }
    total.weight = static_cast<double>(weight);
    return total;
}

TEST(Coarsening, merges_the_cells_of_a_cube) {
    // On the lattice of 2^0 the first three share the cube (0, 0), the others have one each; on
    // 2^-1 there would be ten cells.
    CellSet set;
    for (const auto& [x, y] : {std::pair{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}}) {
        set.cells.push_back(point_at(x, y));
    }
    for (int i = 1; i < 8; ++i) set.cells.push_back(point_at(i + 0.5, 0.5));
    const CellSet merged = coarsen(set, 2, 8);
    EXPECT_EQ(merged.exponent, 0);
    ASSERT_EQ(merged.cells.size(), 8u);
    const Moments& joint = merged.cells[0].moments;
    EXPECT_EQ(joint.count, 3);
    EXPECT_EQ(joint.weight, 3);
    EXPECT_NEAR(joint.mean[0], 1.75 / 3, 1e-15);
    EXPECT_NEAR(joint.mean[1], 1.25 / 3, 1e-15);
    EXPECT_NEAR(joint.deviation[0], std::sqrt(2.0) / 6, 1e-15);  // of 1/4, 3/4, 3/4
}

TEST(Coarsening, leaves_no_more_than_asked_for_and_not_far_fewer) {
    for (const std::size_t most : {8u, 100u, 1000u}) {
        const CellSet merged = coarsen(uniform_points(5000, 1), 2, most);
        EXPECT_LE(merged.cells.size(), most);
        EXPECT_GE(merged.cells.size(), most / 4) << "the next finer lattice would have fitted";
    }
}

TEST(Coarsening, keeps_count_weight_mean_and_deviation_of_the_whole) {
    for (const double offset : {0.0, -0.5, 1e9}) {
        const CellSet set = uniform_points(5000, 2, offset, 1e-3);
        const Moments before = total_of(set);
        const Moments after = total_of(coarsen(set, 2, 64));
        EXPECT_EQ(after.count, before.count);
        EXPECT_EQ(after.weight, before.weight);
        for (std::size_t a = 0; a < 2; ++a) {
            EXPECT_NEAR(after.mean[a], before.mean[a], 2e-16 * (std::abs(offset) + 1e-3));
            // A mean rounds by half of its last digit, which shows beside so small an extent.
            EXPECT_NEAR(after.deviation[a], before.deviation[a],
                        1e-12 * before.deviation[a] + 1e-16 * std::abs(offset));
        }
    }
}

TEST(Coarsening, goes_on_from_a_coarser_lattice_and_never_to_a_finer_one) {
    CellSet set = coarsen(uniform_points(5000, 3), 2, 64);
    const int exponent = set.exponent;
    set.cells.resize(8);
    EXPECT_EQ(coarsen(set, 2, 64).exponent, exponent);
}

TEST(Coarsening, survives_extreme_coordinates) {
    for (const double extent : {1e-310, 1e-300, 1e300, 8e307}) {
        const CellSet merged = coarsen(uniform_points(1000, 4, -extent / 2, extent), 2, 50);
        EXPECT_LE(merged.cells.size(), 50u);
        EXPECT_GE(merged.cells.size(), 4u);
        EXPECT_EQ(total_of(merged).count, 1000);
    }
    CellSet coincident;
    for (int i = 0; i < 100; ++i) coincident.cells.push_back(point_at(1e9, -1e-9));
    const CellSet one = coarsen(coincident, 2, 8);
    ASSERT_EQ(one.cells.size(), 1u);
    EXPECT_EQ(one.cells[0].moments.mean, (Vector{1e9, -1e-9, 0}));
    EXPECT_EQ(one.cells[0].moments.deviation, Vector{});
}

TEST(Coarsening, balances_points_without_weight_by_their_number) {
    CellSet set;
    for (int i = 0; i < 16; ++i) {
        set.cells.push_back(point_at(i < 8 ? i : 0.5 * i, 0));
        set.cells.back().moments.weight = 0;
    }
    for (const CellMoments& cell : coarsen(set, 2, 8).cells) {
        EXPECT_EQ(cell.moments.weight, 0);
        EXPECT_TRUE(std::isfinite(cell.moments.mean[0]));
    }
    // Of 0 ... 7 by 1 and 4 ... 7.5 by 1/2, cubes of edge 1 hold one point or three.
    const CellSet merged = coarsen(set, 2, 8);
    ASSERT_EQ(merged.cells.size(), 8u);
    EXPECT_EQ(merged.cells[3].moments.count, 1);
    EXPECT_EQ(merged.cells[4].moments.count, 3);
    EXPECT_NEAR(merged.cells[4].moments.mean[0], 12.5 / 3, 1e-15);
}

TEST(CellRecords, come_back_with_their_boxes) {
    const std::vector<double> x{0, 0, 4, 2, 1, 1};
    const Points points(x, 2);
    const SupportMesh mesh = make_support_mesh(bounding_box(points), 2, 2);
    const auto cells = cell_moments(points, mesh);
    const CellSet merged = coarsen(uniform_points(100, 5), 2, 16);
    std::vector<double> records;
    append_lean_cells(cells, mesh, 3, records);
    append_cells(merged, 2, 0.5, records);
    const CellSet read = read_cells(records, 2, true);
    const CellSet weighted = read_cells(records, 2, false);
    ASSERT_EQ(read.cells.size(), cells.size() + merged.cells.size());
    EXPECT_EQ(read.exponent, merged.exponent);
    const LeanCells packed = pack_cells(cells, mesh);
    std::vector<CellMoments> unpacked;
    unpack_cells(packed.exponent, packed.bytes, cells.size(), mesh, unpacked);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        EXPECT_EQ(read.cells[i].moments.mean, unpacked[i].moments.mean);
        EXPECT_EQ(read.cells[i].moments.weight, cells[i].moments.weight);
        EXPECT_EQ(weighted.cells[i].moments.weight, 3 * cells[i].moments.weight);
        EXPECT_EQ(read.cells[i].box.lower, cells[i].box.lower);
        EXPECT_EQ(read.cells[i].box.upper, cells[i].box.upper);
    }
    for (std::size_t i = cells.size(); i < read.cells.size(); ++i) {
        const CellMoments& cell = read.cells[i];
        EXPECT_EQ(weighted.cells[i].moments.weight, cell.moments.weight / 2);
        for (std::size_t a = 0; a < 2; ++a) {
            EXPECT_LE(cell.box.lower[a], cell.moments.mean[a]);
            EXPECT_GT(cell.box.upper[a], cell.moments.mean[a]);
            const double edge = std::ldexp(1.0, merged.exponent);
            const double cube = std::floor(cell.moments.mean[a] / edge) * edge;
            const double reach = std::sqrt(3.0) * cell.moments.deviation[a];
            EXPECT_EQ(cell.box.lower[a], std::min(cube, cell.moments.mean[a] - reach));
            EXPECT_EQ(cell.box.upper[a], std::max(cube + edge, cell.moments.mean[a] + reach));
        }
    }
}

}  // namespace
}  // namespace rrcb
