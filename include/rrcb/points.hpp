#pragma once

#if __cplusplus < 202002L
#error "RRCB needs C++20: add -std=c++20 to the options of the compiler"
#endif

#include <rrcb/export.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ranges>
#include <span>
#include <type_traits>

namespace rrcb {

using LocalIndex = std::size_t;        ///< counts points of one rank
using GlobalCount = std::int64_t;      ///< counts points over all ranks
using Part = std::int32_t;             ///< number of a part, 0 ... parts - 1
using Vector = std::array<double, 3>;  ///< a position or lengths, an entry per axis

inline constexpr int max_dimension = 3;  ///< most axes of points

/// Axis-aligned closed box. Axes beyond the dimension of the points are ignored.
///
/// The default is the empty box, whose lower end is above the upper one; joining it with another
/// box does not change that box.
struct Box {
    /// Least coordinates.
    Vector lower{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                 std::numeric_limits<double>::infinity()};
    /// Greatest coordinates.
    Vector upper{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                 -std::numeric_limits<double>::infinity()};
};

/// Borrowed view of one rank's points in 1-D to 3-D. They may be interleaved (xyzxyz...), have one
/// array per axis, or have any other stride, as members of structs have.
///
/// Coordinate a of point i is `axes[a][i * stride]`; the axes may be in one array or in several.
/// Floats are in `float_axes` instead, and are treated as doubles of the same values. `weights` is
/// either empty on every rank with points (then every point weighs 1), or has one finite,
/// non-negative weight for each point. If all weights are 0, or all are the same power of two, the
/// result is bit-identical to that without weights; with other equal weights, rounding may move a
/// cut by one point. The arrays must outlive the view. Nothing is checked here: balance() checks on
/// all ranks together, so that no rank fails alone.
struct Points {
    int dimension = 0;       ///< 1 to 3, the same on every rank
    LocalIndex count = 0;    ///< points of this rank
    std::size_t stride = 1;  ///< distance from a point to the next, in coordinates; not 0
    /// begin at the first point
    std::array<std::span<const double>, max_dimension> axes{};
    std::span<const double> weights{};                               ///< one per point, or empty
    std::array<std::span<const float>, max_dimension> float_axes{};  ///< in place of `axes`

    /// Returns true if coordinates are floats. Not collective, as all of these.
    bool has_floats() const { return float_axes[0].data() != nullptr; }
    /// Returns the coordinate of point `i` along `axis`.
    double coordinate(LocalIndex i, int axis) const {
        const auto a = static_cast<std::size_t>(axis);
        return has_floats() ? float_axes[a][i * stride] : axes[a][i * stride];
    }
    /// Returns the weight of point `i`.
    double weight(LocalIndex i) const { return weights.empty() ? 1.0 : weights[i]; }
    /// Returns the coordinates of point `i`; 0 beyond the dimension.
    Vector position(LocalIndex i) const {
        Vector x{};
        for (int a = 0; a < dimension; ++a) x[static_cast<std::size_t>(a)] = coordinate(i, a);
        return x;
    }
};

/// Returns a view of points that are stored one after the other. Not collective. Nothing is copied.
///
/// @param coordinates doubles, a multiple of `dimension` of them; must outlive the view
/// @param dimension   1 to 3
/// @param weights     empty, or one for each point
RRCB_API Points interleaved_points(std::span<const double> coordinates, int dimension,
                                   std::span<const double> weights = {});

namespace detail {

template <class Range>
concept FloatRange =
    std::ranges::contiguous_range<Range> && std::is_same_v < std::ranges::range_value_t<Range>,
float > ;

RRCB_API Points interleaved_floats(std::span<const float> coordinates, int dimension,
                                   std::span<const double> weights);

}  // namespace detail

/// Returns the same view of floats in any contiguous range. Not collective.
///
/// @param coordinates floats; otherwise as above
/// @param dimension   1 to 3
/// @param weights     empty, or one double for each point
template <detail::FloatRange Floats>
Points interleaved_points(const Floats& coordinates, int dimension,
                          std::span<const double> weights = {}) {
    return detail::interleaved_floats(coordinates, dimension, weights);
}

/// Returns a view of one array per axis. Not collective. Nothing is copied.
///
/// @param columns 1 to 3 arrays of the same length, which must outlive the view
/// @param weights empty, or as long as a column
RRCB_API Points column_points(std::span<const std::span<const double>> columns,
                              std::span<const double> weights = {});
/// Returns the same view of floats. Not collective.
///
/// @param columns 1 to 3 arrays of floats of the same length
/// @param weights empty, or as long as a column
RRCB_API Points column_points(std::span<const std::span<const float>> columns,
                              std::span<const double> weights = {});

/// Returns the smallest box of all points; the empty box if there are none. Not collective.
///
/// The box is NaN on axes with a NaN or infinite coordinate.
RRCB_API Box bounding_box(const Points& points);

}  // namespace rrcb
