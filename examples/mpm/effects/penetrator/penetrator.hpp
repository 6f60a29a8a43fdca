#pragma once

#include "grid/grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace mpm {

/// Depth in a surface, m, and the outward normal there.
template <int D>
struct Touch {
    double depth;
    Components<D> normal;
};

/// A rigid body of revolution about an upright axis: a cone, tip down, below a cylinder.
template <int D>
struct Penetrator {
    Components<D> tip{};     ///< m
    double radius = 0;       ///< m; half the width in two dimensions
    double cone_height = 0;  ///< m; 0: flat
    double length = 0;       ///< m, from tip to top
    double mass = 0;         ///< kg; of the part in the domain where that cuts it by symmetry
    double velocity = 0;     ///< m/s, upwards

    /// Area of the full section of the cylinder, m^2; in two dimensions its width, m.
    double section() const { return D == 2 ? 2 * radius : std::numbers::pi * radius * radius; }

    /// Volume of the full body, m^3; in two dimensions per metre of depth.
    double volume() const { return section() * (cone_height / D + length - cone_height); }

    /// Area of cone and side up to a height above the tip, m^2; in two dimensions the length, m.
    double area_below(double height) const {
        const double in_cone = std::min(height, cone_height);
        const double share = cone_height > 0 ? in_cone / cone_height : 0;
        const double slant = std::hypot(radius, cone_height);
        if constexpr (D == 2) return 2 * (slant * share + height - in_cone);
        return std::numbers::pi * radius * (slant * share * share + 2 * (height - in_cone));
    }

    /// The share of the body in a domain: one half for each side its axis lies on.
    double share_in(const GridShape& grid) const {
        double share = 1;
        for (std::size_t a = 0; a < D; ++a)
            if (a != 1 && (tip[a] <= grid.lower[a] || tip[a] >= grid.upper()[a])) share *= 0.5;
        return share;
    }

    /// Contact of a ball with the nearest surface of cone, side and top; none where they are apart.
    std::optional<Touch<D>> touch(const Vector& at, double ball) const {
        const double height = at[1] - tip[1];
        if (height < -ball || height > length + ball) return std::nullopt;
        Components<D> outward{};
        double square = 0;
        for (std::size_t a = 0; a < D; ++a) {
            if (a != 1) outward[a] = at[a] - tip[a];
            square += outward[a] * outward[a];
        }
        if (square > (radius + ball) * (radius + ball)) return std::nullopt;
        const double distance = std::sqrt(square), slant = std::hypot(radius, cone_height);
        const double to_cone = (radius * height - cone_height * distance) / slant;
        const double to_side = radius - distance, to_top = length - height;
        const double depth = std::min({to_cone, to_side, to_top});
        if (depth < -ball) return std::nullopt;
        const bool is_cone = depth == to_cone, is_top = !is_cone && depth == to_top;
        const double along = is_cone ? cone_height / slant : is_top ? 0 : 1;
        for (double& component : outward) component *= distance > 0 ? along / distance : 0;
        if (is_cone) outward[1] = distance > 0 ? -radius / slant : -1;
        if (is_top) outward[1] = 1;
        return Touch<D>{depth + ball, outward};
    }
};

}  // namespace mpm
