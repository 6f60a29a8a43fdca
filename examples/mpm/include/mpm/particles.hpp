#pragma once

#include <mpm/vector.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mpm {

/// Number of a column of Particles.
using Column = std::size_t;

/// Material points of one rank: named columns of doubles, all of the same length.
///
/// Each user of a property adds its column. All columns travel together. The order of the points
/// changes whenever points are sorted or migrate.
class Particles {
  public:
    /// Adds a column, or finds the one of this name. New points start with 0.
    Column add_column(std::string_view name);
    /// Whether there is a column of this name.
    bool has_column(std::string_view name) const;
    /// Number of a column. Throws std::out_of_range where nobody has added it.
    Column find_column(std::string_view name) const;
    const std::vector<std::string>& column_names() const { return names_; }

    std::size_t size() const { return size_; }
    double* data(Column column) { return columns_[column].data(); }
    std::span<const double> operator[](Column column) const {
        return {columns_[column].data(), size_};
    }
    /// Column by name, for readers outside the step.
    std::span<const double> operator[](std::string_view name) const {
        return (*this)[find_column(name)];
    }

    /// Appends rows, each of one value per column in the order of the columns.
    void append(std::span<const double> rows);
    /// Copies one point into a row of one value per column.
    void copy_row(std::size_t point, std::span<double> row) const;
    /// Removes points given in ascending order. The last points take their places.
    void remove(std::span<const std::size_t> points);
    /// Puts the point order[i] in place i.
    void reorder(std::span<const std::size_t> order);

  private:
    std::vector<std::string> names_;
    std::vector<std::vector<double>> columns_;
    std::vector<double> scratch_;
    std::size_t size_ = 0;
};

/// The columns every scene has; of each triple the first two in two dimensions.
struct MotionColumns {
    std::array<Column, 3> position{};  ///< x, y, z, m
    std::array<Column, 3> velocity{};  ///< velocity_x, ..., m/s
    Column mass = 0;                   ///< kg; per metre of depth in two dimensions
    Column volume = 0;                 ///< m^3; per metre of depth in two dimensions
    Column id = 0;  ///< number of the point in the scene, which tells where it started
};

MotionColumns add_motion_columns(Particles& particles, int dimension);

/// Borrowed positions of all points.
Positions positions_of(const Particles& particles, const MotionColumns& motion, int dimension);

}  // namespace mpm
