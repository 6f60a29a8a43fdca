#pragma once

#include "effects/time_function.hpp"
#include "grid/grid.hpp"

#include <mpm/scene.hpp>

#include <cmath>
#include <optional>

namespace mpm {

template <int D>
inline double along_normal(const Components<D>& normal, const Components<D>& velocity) {
    double across = 0;
    for (std::size_t a = 0; a < D; ++a) across += velocity[a] * normal[a];
    return across;
}

/// Vector of unit length along numbers that are not all 0.
template <int D, typename Numbers>
Components<D> unit_of(const Numbers& numbers) {
    double square = 0;
    for (std::size_t a = 0; a < D; ++a) square += numbers[a] * numbers[a];
    Components<D> unit;
    for (std::size_t a = 0; a < D; ++a) unit[a] = numbers[a] / std::sqrt(square);
    return unit;
}

/// Solid ground behind a plane, which may move.
template <int D>
class Ground {
  public:
    explicit Ground(const Plane& plane) : normal(unit_of<D>(plane.normal)) {
        for (std::size_t a = 0; a < D; ++a) level_ += normal[a] * plane.point[a];
        const Motion& motion = plane.wall.motion;
        if (motion.speeds.empty()) return;
        direction_ = unit_of<D>(motion.direction);
        speed_.emplace(motion.times, motion.speeds, plane.name);
    }

    /// Where a position of a time was at the start, if it moves with the ground.
    Components<D> origin(Components<D> at, double time) const {
        for (std::size_t a = 0; speed_ && a < D; ++a)
            at[a] -= speed_->integral(time) * direction_[a];
        return at;
    }

    /// Height above the plane of an origin, m.
    double height(const Components<D>& origin) const {
        return along_normal<D>(normal, origin) - level_;
    }

    Components<D> velocity(double time) const {
        Components<D> velocity{};
        for (std::size_t a = 0; speed_ && a < D; ++a)
            velocity[a] = speed_->at(time) * direction_[a];
        return velocity;
    }

    Components<D> normal;  ///< outward, of unit length

  private:
    double level_ = 0;  ///< along the normal at the start, m
    Components<D> direction_{};
    std::optional<TimeFunction> speed_ = {};  ///< along the direction, m/s
};

}  // namespace mpm
