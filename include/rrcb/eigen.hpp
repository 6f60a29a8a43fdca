#pragma once

#include <rrcb/points.hpp>

#include <Eigen/Core>

namespace rrcb {

/// Returns a view of a column-major matrix with one point per column. Not collective. Your program
/// has to link Eigen3::Eigen as well; rrcb::rrcb does not do that.
///
/// @param coordinates 1 to 3 rows of doubles or floats; must outlive the view
/// @param weights     empty, or one entry per column
template <class Scalar, int Rows>
Points eigen_points(const Eigen::Matrix<Scalar, Rows, Eigen::Dynamic>& coordinates,
                    std::span<const double> weights = {}) {
    const auto size = static_cast<std::size_t>(coordinates.size());
    return interleaved_points(std::span(coordinates.data(), size),
                              static_cast<int>(coordinates.rows()), weights);
}

}  // namespace rrcb
