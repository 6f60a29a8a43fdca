#pragma once

#include "grid/grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mpm {

template <int D>
inline double along_normal(const Components<D>& normal, const Components<D>& velocity) {
    double across = 0;
    for (std::size_t a = 0; a < D; ++a) across += velocity[a] * normal[a];
    return across;
}

/// Solid ground behind a plane.
template <int D>
struct Ground {
    Components<D> normal;  ///< outward, of unit length
    double level;          ///< of the plane along the normal, m

    double height(const Components<D>& at) const { return along_normal<D>(normal, at) - level; }
};

template <int D>
Ground<D> ground_of(const Plane& plane) {
    double square = 0;
    for (std::size_t a = 0; a < D; ++a) square += plane.normal[a] * plane.normal[a];
    Ground<D> ground{};
    for (std::size_t a = 0; a < D; ++a) {
        ground.normal[a] = plane.normal[a] / std::sqrt(square);
        ground.level += ground.normal[a] * plane.point[a];
    }
    return ground;
}

/// A surface as a node meets it.
template <int D>
struct Surface {
    Components<D> normal;  ///< outward, of unit length
    double friction = 0;   ///< Coulomb's coefficient
    double yield = 0;      ///< speed at which it gives way, m/s
};

/// How frictional walls give way to the nodes that press on them: as a thin layer of springs and
/// dashpots.
///
/// On rigid ground Coulomb's friction makes an elastic body flutter, whose surface then sticks and
/// slips by turns and is held by less than the coefficient times its weight. A dashpot with the
/// impedance of the body takes its vibrations (Lysmer and Kuhlemeyer 1969). The spring, whose force
/// is the load's mean over some transits of a wave through a cell, bears the weight.
class Bed {
  public:
    /// Gives way by at most `most`, m.
    Bed(double wave_speed, double spacing, double most)
        : rate_(wave_speed / spacing), most_(most), relaxation_(rate_ / 10) {}

    /// Speed at which the surface gives way to a node that comes at a speed `into` it; 0 where the
    /// node leaves it. `depth` is how far it has given way, 0 before the
    /// first contact. The spring then bears that load at once: a body that slides onto the next
    /// node sinks no deeper.
    double yield(double into, double time_step, double& depth) const {
        const double damping = 2 * rate_ * time_step;  // A node stands for half a cell.
        if (depth == 0) depth = std::clamp(into / (damping * relaxation_), 0.0, most_);
        const double speed = std::clamp((into - damping * relaxation_ * depth) / (1 + damping),
                                        -depth / time_step, (most_ - depth) / time_step);
        const bool leaves = into <= speed;
        depth = leaves ? depth * std::exp(-relaxation_ * time_step) : depth + speed * time_step;
        return leaves ? 0 : speed;
    }

  private:
    double rate_;        ///< of transits of a wave through a cell, 1/s
    double most_;        ///< m
    double relaxation_;  ///< 1/s
};

/// Velocity after contact, without its part into the surface and less by friction along it.
///
/// A velocity that leaves the surface, as it gives way, stays as it is. The tangential velocity
/// goes down by at most friction * the loss of the normal one (Bardenhagen, Brackbill and Sulsky
/// 2000).
template <int D>
inline Components<D> after_contact(const Surface<D>& surface, const Components<D>& velocity) {
    const double across = along_normal<D>(surface.normal, velocity);
    const double relative = across + surface.yield;
    if (relative >= 0) return velocity;
    Components<D> along{};
    double square = 0;
    for (std::size_t a = 0; a < D; ++a) {
        along[a] = velocity[a] - across * surface.normal[a];
        square += along[a] * along[a];
    }
    const double speed = std::sqrt(square);
    const double lost = -surface.friction * relative;
    const double left = speed > lost ? 1 - lost / speed : 0;
    for (std::size_t a = 0; a < D; ++a)
        along[a] = left * along[a] - surface.yield * surface.normal[a];
    return along;
}

/// Velocities of a node beyond a surface and of its mirror image inside, after the surface has kept
/// their mean out of it, with equal impulses on both.
///
/// The surface lies where shape functions read the mean of the two. Equal impulses do no work where
/// it is at rest.
template <int D>
inline std::array<Components<D>, 2> after_contact(Surface<D> surface,
                                                  std::array<Components<D>, 2> velocities,
                                                  const std::array<double, 2>& masses) {
    Components<D> sum;
    for (std::size_t a = 0; a < D; ++a) sum[a] = velocities[0][a] + velocities[1][a];
    surface.yield *= 2;
    const Components<D> left = after_contact<D>(surface, sum);
    for (std::size_t a = 0; a < D; ++a) {
        const double change = left[a] - sum[a];
        velocities[0][a] += masses[1] / (masses[0] + masses[1]) * change;
        velocities[1][a] += masses[0] / (masses[0] + masses[1]) * change;
    }
    return velocities;
}

/// Corrects all velocities of a node that has moved by `left(velocity)`, so that points are
/// strained, moved and pushed by what it leaves.
template <int D, typename Left>
inline void correct(NodeMotion<D>& motion, Left left) {
    const Components<D> velocity = left(motion.velocity);
    for (std::size_t a = 0; a < D; ++a)
        motion.velocity_change[a] += velocity[a] - motion.velocity[a];
    motion.velocity = velocity;
    motion.strain_velocity = left(motion.strain_velocity);
}

}  // namespace mpm
