// Poisson's equation on the inner points of a grid in the unit cube, for clients that solve it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

/// Whole planes of the grid lie on a rank; a later rank has more of them, so that there is
/// something to balance.
struct Poisson {
    int points_per_axis, begin_plane, end_plane;

    Poisson(int points, int rank, int num_ranks)
        : points_per_axis(points),
          begin_plane(plane_of(points, rank, num_ranks)),
          end_plane(plane_of(points, rank + 1, num_ranks)) {}

    int plane_size() const { return points_per_axis * points_per_axis; }
    int num_rows() const { return (end_plane - begin_plane) * plane_size(); }
    int row(int index) const { return begin_plane * plane_size() + index; }

    std::array<int, 3> indices_of(int row) const {
        return {row % points_per_axis, row / points_per_axis % points_per_axis, row / plane_size()};
    }
    double coordinate(int row, int axis) const {
        return (indices_of(row)[static_cast<std::size_t>(axis)] + 1.0) / (points_per_axis + 1);
    }
    /// The row itself first, then its neighbours; the matrix has 6 and -1 there.
    std::vector<int> columns_of(int row) const {
        std::vector<int> columns{row};
        int step = 1;
        for (const int index : indices_of(row)) {
            if (index > 0) columns.push_back(row - step);
            if (index + 1 < points_per_axis) columns.push_back(row + step);
            step *= points_per_axis;
        }
        return columns;
    }
    /// Whether the right-hand side 1 gave the solution known from its series, 0.0562 in the centre.
    bool is_solved(double largest) const {
        const double spacing = 1.0 / (points_per_axis + 1);
        return std::abs(largest * spacing * spacing - 0.0562) < 0.001;
    }

  private:
    static int plane_of(int points, int rank, int num_ranks) {
        return points * rank * (rank + 1) / (num_ranks * (num_ranks + 1));
    }
};
