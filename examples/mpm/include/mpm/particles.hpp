#pragma once

#include <mpm/vector.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mpm {

/// The index of a column of Particles.
using Column = std::size_t;

/// The material points of one rank: named columns of doubles, all of the same length.
///
/// Code that needs a property of the points adds a column for it. All columns migrate with the
/// points. The order of the points changes whenever they are sorted or migrate.
class Particles {
  public:
    /// Adds a column, or returns the existing one of this name. New points start with the value 0.
    Column add_column(std::string_view name);
    /// Returns whether there is a column of this name.
    bool has_column(std::string_view name) const;
    /// Returns the index of a column. Throws std::out_of_range if there is none of this name.
    Column find_column(std::string_view name) const;
    const std::vector<std::string>& column_names() const { return names_; }

    std::size_t size() const { return columns_.empty() ? 0 : columns_.front().size(); }
    /// All columns, for calls that move points to other ranks.
    std::vector<std::vector<double>>& columns() { return columns_; }
    double* data(Column column) { return columns_[column].data(); }
    std::span<const double> operator[](Column column) const { return columns_[column]; }
    /// Returns a column by its name. Kernels of a step use indices, which are faster.
    std::span<const double> operator[](std::string_view name) const {
        return (*this)[find_column(name)];
    }

    /// Appends points. Each row has one value per column, in the order of the columns.
    void append(std::span<const double> rows);
    /// Copies one point into a row that has one value per column.
    void copy_row(std::size_t point, std::span<double> row) const;
    /// Removes points, given in ascending order. The last points move to their places.
    void remove(std::span<const std::size_t> points);
    /// Moves the point order[i] to position i.
    void reorder(std::span<const std::size_t> order);

  private:
    std::vector<std::string> names_;
    std::vector<std::vector<double>> columns_;
    std::vector<double> scratch_;
};

/// The columns that every scene has. Two-dimensional scenes have the first two of each triple.
struct MotionColumns {
    std::array<Column, 3> position{};  ///< x, y, z, m
    std::array<Column, 3> velocity{};  ///< velocity_x, ..., m/s
    Column mass = 0;                   ///< kg; per metre of depth in two dimensions
    Column volume = 0;                 ///< m^3; per metre of depth in two dimensions
    Column id = 0;  ///< number of the point in the scene, from which its start position follows
};

MotionColumns add_motion_columns(Particles& particles, int dimension);

/// Returns a view of the positions of all points.
Positions positions_of(const Particles& particles, const MotionColumns& motion, int dimension);

}  // namespace mpm
