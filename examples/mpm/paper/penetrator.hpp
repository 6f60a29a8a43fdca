#pragma once

#include "grid/grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace mpm {

/// Depth of a ball inside a surface, m, and the outward normal of the surface there.
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
    double mass = 0;  ///< mass, kg; only of the part inside the domain if a side of the domain cuts
                      ///< the body
    double velocity = 0;  ///< m/s, upwards

    /// Returns the cross-section of the cylinder, m^2; in two dimensions its width, m.
    double section() const { return D == 2 ? 2 * radius : std::numbers::pi * radius * radius; }

    /// Returns the volume of the full body, m^3; in two dimensions per metre of depth.
    double volume() const { return section() * (cone_height / D + length - cone_height); }

    /// Returns the surface area of cone and side up to a height above the tip, m^2; in two
    /// dimensions the length, m.
    double area_below(double height) const {
        const double in_cone = std::min(height, cone_height);
        const double share = cone_height > 0 ? in_cone / cone_height : 0;
        const double slant = std::hypot(radius, cone_height);
        if constexpr (D == 2) return 2 * (slant * share + height - in_cone);
        return std::numbers::pi * radius * (slant * share * share + 2 * (height - in_cone));
    }

    /// Returns the share of the body inside the domain: it halves for each side that contains the
    /// axis.
    double share_in(const GridShape& grid) const {
        double share = 1;
        for (std::size_t a = 0; a < D; ++a)
            if (a != 1 && (tip[a] <= grid.lower[a] || tip[a] >= grid.upper()[a])) share *= 0.5;
        return share;
    }

    /// Returns the contact of a ball with the nearest surface of the body, or nullopt if they are
    /// apart.
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

/// Limits the friction on a penetrator if the shear stress has a limit.
///
/// The area in contact cannot be computed from the points at the surface: they are too few and too
/// distorted. It is computed from the body, whose surface is divided into bands of equal height.
/// The ratio of friction to normal force is at most (mean limit of shear stress * area of the band)
/// / (mean normal force on the band). The means are over the latest steps.
template <int D>
class FrictionBands {
  public:
    /// `share` is the part of the body in the domain. `height` is the approximate height of a band,
    /// m.
    FrictionBands(const Penetrator<D>& body, double height, double share)
        : length_(body.length), areas_(static_cast<std::size_t>(std::ceil(body.length / height))) {
        for (std::size_t k = 0; k < areas_.size(); ++k)
            areas_[k] = share * (body.area_below(edge(k + 1)) - body.area_below(edge(k)));
        sums_.resize(2 * areas_.size());
        means_ = sums_;
    }

    /// Adds the normal force on a point, N, at a height above the tip, m, and the point's limit of
    /// shear stress, Pa.
    void add(double height, double normal_force, double limit) {
        const std::size_t k = band_at(height);
        sums_[2 * k] += normal_force;
        sums_[2 * k + 1] += normal_force * limit;
    }

    /// Returns the largest ratio of friction to normal force at a height above the tip; at most
    /// `friction`.
    double most_at(double height, double friction) const {
        const std::size_t k = band_at(height);
        const double normal = means_[2 * k], allowed = areas_[k] * means_[2 * k + 1];
        return allowed < friction * normal * normal ? allowed / (normal * normal) : friction;
    }

    /// Returns this rank's sums of the step. The caller sums them over the ranks.
    std::span<const double> sums() const { return sums_; }

    /// Adds the sums over all ranks to the moving means, with a weight, and begins a new step.
    void settle(std::span<const double> sums, double weight) {
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            means_[i] += weight * (sums[i] - means_[i]);
            sums_[i] = 0;
        }
    }

    /// Returns the moving means, which are kept between steps.
    std::span<double> means() { return means_; }

  private:
    double edge(std::size_t k) const {
        return length_ * static_cast<double>(k) / static_cast<double>(areas_.size());
    }
    std::size_t band_at(double height) const {
        const double place = std::max(height, 0.0) / length_ * static_cast<double>(areas_.size());
        return std::min(static_cast<std::size_t>(place), areas_.size() - 1);
    }

    double length_;
    std::vector<double> areas_;         ///< m^2; in two dimensions m
    std::vector<double> sums_, means_;  ///< by band: the normal force, and the product of normal
                                        ///< force and limit
};

}  // namespace mpm
