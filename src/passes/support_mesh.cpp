#include "arithmetic/safe_scale.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <rrcb/detail/support_mesh.hpp>

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

// Squares of lengths between 2^-453 and 2^401 are normal doubles. Other lengths are scaled.
double scale_of_lengths(double lower, double upper) {
    constexpr int harmless_exponent = 400;
    return safe_scale(std::max(std::abs(lower), std::abs(upper)), harmless_exponent);
}

}  // namespace

SupportMesh make_support_mesh(const Box& box, int dimension, int cells_per_axis) {
    check_dimension(dimension, "the mesh");
    require(cells_per_axis >= 1, "cells_per_axis must be at least 1");
    SupportMesh mesh;
    mesh.dimension = dimension;
    mesh.box = mesh.frame = box;
    for (int a = 0; a < dimension; ++a) {
        if (!(box.lower[a] < box.upper[a])) continue;
        mesh.scale[a] = scale_of_lengths(box.lower[a], box.upper[a]);
        mesh.cells[a] = cells_per_axis;
        mesh.cells_per_length[a] =
            cells_per_axis / (box.upper[a] * mesh.scale[a] - box.lower[a] * mesh.scale[a]);
    }
    return mesh;
}

LocalIndex num_cells(const SupportMesh& mesh) {
    LocalIndex product = 1;
    for (const int cells : mesh.cells) product *= static_cast<LocalIndex>(cells);
    return product;
}

LocalIndex cell_of(const SupportMesh& mesh, const Vector& position) {
    LocalIndex cell = 0;
    LocalIndex stride = 1;
    for (int a = 0; a < mesh.dimension; ++a) {
        const double offset = position[a] * mesh.scale[a] - mesh.frame.lower[a] * mesh.scale[a];
        const double layer =
            std::clamp(offset * mesh.cells_per_length[a], 0.0, mesh.cells[a] - 1.0);
        cell += stride * static_cast<LocalIndex>(layer);
        stride *= static_cast<LocalIndex>(mesh.cells[a]);
    }
    return cell;
}

Box cell_box(const SupportMesh& mesh, LocalIndex cell) {
    Box box;
    for (int a = 0; a < mesh.dimension; ++a) {
        const auto cells = static_cast<LocalIndex>(mesh.cells[a]);
        const LocalIndex layer = cell % cells;
        cell /= cells;
        const auto face = [&](LocalIndex k) {
            if (k == 0) return mesh.box.lower[a];
            if (k == cells) return mesh.box.upper[a];
            return std::lerp(mesh.frame.lower[a], mesh.frame.upper[a],
                             static_cast<double>(k) / static_cast<double>(cells));
        };
        box.lower[a] = face(layer);
        box.upper[a] = face(layer + 1);
    }
    return box;
}

}  // namespace rrcb
