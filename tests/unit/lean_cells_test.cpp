#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "estimate/cell_records.hpp"

#include <rrcb/detail/support_mesh.hpp>

namespace rrcb {
namespace {

/// Every `gap`-th cell of a mesh, with any moments that points in it may have.
std::vector<CellMoments> random_cells(const SupportMesh& mesh, LocalIndex gap, double weight) {
    std::mt19937_64 engine(3);
    std::vector<CellMoments> cells;
    for (LocalIndex number = 0; number < num_cells(mesh); number += gap) {
        CellMoments cell{number, cell_box(mesh, number), {}};
        cell.moments.count = static_cast<GlobalCount>(1 + engine() % 1000);
        cell.moments.weight = weight * test::uniform(engine);
        for (std::size_t a = 0; a < static_cast<std::size_t>(mesh.dimension); ++a) {
            const double u = test::uniform(engine);
            const double half = cell.box.upper[a] / 2 - cell.box.lower[a] / 2;
            cell.moments.mean[a] = std::lerp(cell.box.lower[a], cell.box.upper[a], u);
            cell.moments.deviation[a] = test::uniform(engine) * 2 * std::sqrt(u * (1 - u)) * half;
        }
        cells.push_back(cell);
    }
    return cells;
}

std::vector<CellMoments> unpacked(const std::vector<CellMoments>& cells, const SupportMesh& mesh) {
    const LeanCells lean = pack_cells(cells, mesh);
    std::vector<CellMoments> result;
    unpack_cells(lean.exponent, lean.bytes, cells.size(), mesh, result);
    return result;
}

Box cube(double lower, double upper, int dimension) {
    Box box{{0, 0, 0}, {0, 0, 0}};
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
        box.lower[a] = lower;
        box.upper[a] = upper;
    }
    return box;
}

TEST(LeanCells, take_eight_bytes_in_2d_and_ten_in_3d) {
    for (const int dimension : {1, 2, 3}) {
        const SupportMesh mesh = make_support_mesh(cube(0, 1, dimension), dimension, 20);
        const auto cells = random_cells(mesh, 1, 1);
        const std::size_t each = 4 + 2 * static_cast<std::size_t>(dimension);
        EXPECT_LE(pack_cells(cells, mesh).bytes.size(), cells.size() * each);
        // A gap costs a byte.
        const auto apart = random_cells(mesh, 3, 1);
        EXPECT_LE(pack_cells(apart, mesh).bytes.size(), apart.size() * (each + 1));
    }
}

TEST(LeanCells, come_back_within_half_a_step) {
    constexpr double largest = std::numeric_limits<double>::max();
    const std::vector<std::pair<double, double>> ends{
        {0, 1}, {1e9, 1e9 + 1e-3}, {-1e-310, 1e-310}, {-largest, largest}, {-1e300, 2e300}};
    for (const auto& [lower, upper] : ends) {
        for (const int dimension : {1, 2, 3}) {
            const SupportMesh mesh = make_support_mesh(cube(lower, upper, dimension), dimension, 7);
            const auto cells = random_cells(mesh, 2, 3);
            const auto read = unpacked(cells, mesh);
            ASSERT_EQ(read.size(), cells.size());
            for (std::size_t i = 0; i < cells.size(); ++i) {
                EXPECT_EQ(read[i].cell, cells[i].cell);
                EXPECT_EQ(read[i].box.lower, cells[i].box.lower);
                EXPECT_EQ(read[i].box.upper, cells[i].box.upper);
                EXPECT_NEAR(read[i].moments.weight, cells[i].moments.weight, 3e-7);
                for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
                    const double half = cells[i].box.upper[a] / 2 - cells[i].box.lower[a] / 2;
                    const double off = read[i].moments.mean[a] / 2 - cells[i].moments.mean[a] / 2;
                    EXPECT_LE(std::abs(off) / half, 0.501 / 255);
                    const double before = cells[i].moments.deviation[a] / half;
                    const double after = read[i].moments.deviation[a] / half;
                    const double off_code = before > 0.07
                                                ? (std::sqrt(after) - std::sqrt(before)) * 255
                                                : std::log2(after / before) / 0.6;
                    EXPECT_LE(std::abs(off_code), before > 0.07 ? 0.501 : 0.52);
                }
            }
        }
    }
}

TEST(LeanCells, keep_faces_and_what_has_no_extent) {
    const SupportMesh mesh = make_support_mesh({{0, 5, 0}, {1, 5, 0}}, 2, 3);
    std::vector<CellMoments> cells = random_cells(mesh, 1, 1);
    cells[0].moments.mean[0] = cells[0].box.lower[0];
    cells[1].moments.mean[0] = cells[1].box.upper[0];
    cells[1].moments.deviation[0] = 0;
    cells[2].moments.deviation[0] = 1e-30;
    const auto read = unpacked(cells, mesh);
    const double step = 1.0 / 3 / 255;
    EXPECT_GT(read[0].moments.mean[0], cells[0].box.lower[0]) << "its deviation is above 0";
    EXPECT_LE(read[0].moments.mean[0], cells[0].box.lower[0] + step / 2);
    EXPECT_EQ(read[1].moments.mean[0], cells[1].box.upper[0]);
    EXPECT_EQ(read[1].moments.deviation[0], 0);
    EXPECT_GT(read[2].moments.deviation[0], 0);
    for (const CellMoments& cell : read) {
        EXPECT_EQ(cell.moments.mean[1], 5);
        EXPECT_EQ(cell.moments.deviation[1], 0);
    }
}

TEST(LeanCells, know_deviations_of_twelve_decades) {
    const SupportMesh mesh = make_support_mesh(cube(-1, 1, 1), 1, 1);
    for (double deviation = 1; deviation > 4e-13; deviation *= 0.99) {
        auto cells = random_cells(mesh, 1, 1);
        cells[0].moments.deviation[0] = deviation;
        const double read = unpacked(cells, mesh)[0].moments.deviation[0];
        EXPECT_LE(std::abs(std::log2(read / deviation)), deviation > 0.07 ? 0.025 : 0.301);
    }
}

TEST(LeanCells, have_weights_over_any_range) {
    const SupportMesh mesh = make_support_mesh(cube(0, 1, 1), 1, 400);
    for (const double heaviest : {1e-300, 1.0, 1e300}) {
        auto cells = random_cells(mesh, 1, 1);
        for (std::size_t i = 0; i < cells.size(); ++i)
            cells[i].moments.weight = heaviest * std::pow(10, -0.15 * static_cast<double>(i));
        const auto read = unpacked(cells, mesh);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const double weight = cells[i].moments.weight;
            EXPECT_NEAR(read[i].moments.weight / heaviest, weight / heaviest,
                        std::max(6e-8 * weight / heaviest, 1e-44));
            EXPECT_GE(read[i].moments.weight > 0, weight > heaviest * 1e-44);
            EXPECT_EQ(read[i].moments.count, 0) << "not known";
        }
    }
}

TEST(LeanCells, of_no_points_are_none) {
    const SupportMesh mesh = make_support_mesh(cube(0, 1, 2), 2, 4);
    EXPECT_TRUE(pack_cells({}, mesh).bytes.empty());
    EXPECT_TRUE(unpacked({}, mesh).empty());
}

}  // namespace
}  // namespace rrcb
