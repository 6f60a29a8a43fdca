#pragma once

#include "options/axis_order.hpp"

#include <rrcb/options.hpp>
#include <rrcb/points.hpp>

#include <array>
#include <span>

namespace rrcb {

/// Returns the axes 0, 1, ...
inline std::span<const int> first_axes(int dimension) {
    static constexpr std::array<int, max_dimension> axes{0, 1, 2};
    return std::span(axes).first(static_cast<std::size_t>(dimension));
}

/// Returns the axes that cuts may cross, in order of preference.
inline std::span<const int> allowed_axes(const AxisOrder& order, int dimension) {
    return is_among(order) ? std::span(axes_in(order)) : first_axes(dimension);
}

}  // namespace rrcb
