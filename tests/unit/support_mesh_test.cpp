#include <rrcb/detail/support_mesh.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace rrcb {
namespace {

Box box_2d(double x0, double y0, double x1, double y1) {
    Box box;
    box.lower = {x0, y0, 0};
    box.upper = {x1, y1, 0};
    return box;
}

TEST(SupportMesh, numbers_cells_fastest_along_the_first_axis) {
    const SupportMesh mesh = make_support_mesh(box_2d(0, 0, 4, 8), 2, 4);
    EXPECT_EQ(num_cells(mesh), 16u);
    EXPECT_EQ(cell_of(mesh, {0.5, 0.5, 0}), 0u);
    EXPECT_EQ(cell_of(mesh, {1.5, 0.5, 0}), 1u);
    EXPECT_EQ(cell_of(mesh, {0.5, 2.5, 0}), 4u);
    EXPECT_EQ(cell_of(mesh, {3.5, 7.5, 0}), 15u);
}

TEST(SupportMesh, upper_face_of_the_box_belongs_to_the_last_cell) {
    const SupportMesh mesh = make_support_mesh(box_2d(0, 0, 1, 1), 2, 3);
    EXPECT_EQ(cell_of(mesh, {1, 1, 0}), 8u);
    EXPECT_EQ(cell_of(mesh, {7, -3, 0}), 2u);
}

TEST(SupportMesh, an_axis_without_extent_has_one_layer) {
    const SupportMesh mesh = make_support_mesh(box_2d(2, 0, 2, 1), 2, 5);
    EXPECT_EQ(num_cells(mesh), 5u);
    EXPECT_EQ(cell_of(mesh, {2, 0.99, 0}), 4u);
}

TEST(SupportMesh, cells_share_faces_to_the_bit_and_fill_the_box) {
    const SupportMesh mesh = make_support_mesh(box_2d(0.1, -3, 0.7, 1e-3), 2, 7);
    EXPECT_EQ(cell_box(mesh, 0).lower[0], 0.1);
    EXPECT_EQ(cell_box(mesh, 48).upper[0], 0.7);
    EXPECT_EQ(cell_box(mesh, 48).upper[1], 1e-3);
    for (LocalIndex cell = 0; cell < 6; ++cell)
        EXPECT_EQ(cell_box(mesh, cell).upper[0], cell_box(mesh, cell + 1).lower[0]);
}

TEST(SupportMesh, divides_the_whole_range_of_double) {
    constexpr double huge = std::numeric_limits<double>::max();
    const SupportMesh mesh = make_support_mesh(box_2d(-huge, 0, huge, 5e-324), 2, 4);
    EXPECT_EQ(cell_of(mesh, {-huge, 0, 0}), 0u);
    EXPECT_EQ(cell_of(mesh, {-huge / 4, 0, 0}), 1u);
    EXPECT_EQ(cell_of(mesh, {huge, 5e-324, 0}), 15u);
    EXPECT_DOUBLE_EQ(cell_box(mesh, 0).upper[0], -huge / 2);
}

}  // namespace
}  // namespace rrcb
