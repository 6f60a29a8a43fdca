#pragma once

#include "contact.hpp"

#include <optional>

namespace mpm {

/// A rigid body of revolution about an upright axis: a cone, tip down, below a cylinder.
template <int D>
struct Penetrator {
    Components<D> tip{};     ///< m
    double radius = 0;       ///< m; half the width in two dimensions
    double cone_height = 0;  ///< m; 0: flat
    double length = 0;       ///< m, from tip to top
    double mass = 0;         ///< kg; of the part in the domain where that cuts it by symmetry
    double velocity = 0;     ///< m/s, upwards

    /// The outward normal of the nearer of cone and side for a position inside, else none.
    std::optional<Components<D>> normal_inside(const Vector& at) const {
        Components<D> outward{};
        double square = 0;
        for (std::size_t a = 0; a < D; ++a) {
            if (a != 1) outward[a] = at[a] - tip[a];
            square += outward[a] * outward[a];
        }
        const double distance = std::sqrt(square), height = at[1] - tip[1];
        const double slant = std::hypot(radius, cone_height);
        const double to_cone = (radius * height - cone_height * distance) / slant;
        const double to_side = radius - distance;
        if (to_cone < 0 || to_side < 0 || height > length) return std::nullopt;
        const bool is_cone = to_cone <= to_side;
        const double along = is_cone ? cone_height / slant : 1;
        for (double& component : outward) component *= distance > 0 ? along / distance : 0;
        if (is_cone) outward[1] = -radius / slant;
        // On the axis of a cone only what points down is left.
        if (distance == 0) outward[1] = -1;
        return outward;
    }
};

}  // namespace mpm
