#include "grains.hpp"

#include "counter_random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace comparisons {

namespace {

using rrcb::Vector;

constexpr double stiffness = 1000;
constexpr double damping = 10;      ///< force divided by speed
constexpr double time_step = 0.01;  ///< a seventh of the duration of the shortest contact

double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector added(const Vector& a, double factor, const Vector& b) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

/// Returns the contact force on a body. Normal to the contact it is elastic and damped. Along the
/// contact it is viscous, up to the limit of friction.
///
/// @param normal is a unit vector that points towards the body
/// @param velocity of the body relative to the other body
Vector contact_force(const Vector& normal, double overlap, const Vector& velocity,
                     double friction) {
    const double across = dot(velocity, normal);
    const double pressure = std::max(0.0, stiffness * overlap - damping * across);
    const Vector along = added(velocity, -across, normal);
    const double speed = std::sqrt(dot(along, along));
    const double brake = std::min(damping * speed, friction * pressure);
    const Vector force{pressure * normal[0], pressure * normal[1], pressure * normal[2]};
    return speed > 0 ? added(force, -brake / speed, along) : force;
}

/// Computes the forces of a step.
class Step {
  public:
    explicit Step(const Grains& grains)
        : grains_(grains),
          up_(static_cast<std::size_t>(grains.dimension) - 1),
          forces_(grains.x.size()),
          cells_(grains.x.size()),
          next_(grains.x.size()) {
        for (std::size_t i = 0; i < grains.x.size(); ++i) {
            forces_[i][up_] = -1;
            touch_walls(i);
            touch_grains(i);
        }
    }

    const std::vector<Vector>& forces() const { return forces_; }

  private:
    void touch_wall(std::size_t i, std::size_t axis, double direction, double distance) {
        if (distance >= 0.5) return;
        Vector normal{};
        normal[axis] = direction;
        forces_[i] = added(forces_[i], 1,
                           contact_force(normal, 0.5 - distance, grains_.v[i], grains_.friction));
    }

    void touch_walls(std::size_t i) {
        touch_wall(i, up_, 1, grains_.x[i][up_]);
        if (grains_.wall > 0) {
            touch_wall(i, 0, 1, grains_.x[i][0] + grains_.wall);
            touch_wall(i, 0, -1, grains_.wall - grains_.x[i][0]);
        }
    }

    /// Computes the contacts of grain i with earlier grains in the neighbouring cells, then adds it
    /// to its own cell.
    void touch_grains(std::size_t i) {
        std::array<std::int64_t, 3> at{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            at[axis] = static_cast<std::int64_t>(std::floor(grains_.x[i][axis])) + offset;
        const std::int64_t layers = grains_.dimension == 3 ? 1 : 0;
        for (std::int64_t z = at[2] - layers; z <= at[2] + layers; ++z)
            for (std::int64_t y = at[1] - 1; y <= at[1] + 1; ++y)
                for (std::int64_t x = at[0] - 1; x <= at[0] + 1; ++x) {
                    const std::int64_t cell = cell_of(x, y, z);
                    for (int j = heads_[bucket(cell)]; j >= 0;
                         j = next_[static_cast<std::size_t>(j)])
                        if (cells_[static_cast<std::size_t>(j)] == cell)
                            touch(i, static_cast<std::size_t>(j));
                }
        cells_[i] = cell_of(at[0], at[1], at[2]);
        next_[i] = std::exchange(heads_[bucket(cells_[i])], static_cast<int>(i));
    }

    void touch(std::size_t i, std::size_t j) {
        const Vector between = added(grains_.x[i], -1, grains_.x[j]);
        const double squared = dot(between, between);
        if (squared >= 1 || squared <= 0) return;
        const double distance = std::sqrt(squared);
        const Vector normal{between[0] / distance, between[1] / distance, between[2] / distance};
        const Vector force = contact_force(normal, 1 - distance,
                                           added(grains_.v[i], -1, grains_.v[j]), grains_.friction);
        forces_[i] = added(forces_[i], 1, force);
        forces_[j] = added(forces_[j], -1, force);
    }

    static constexpr std::int64_t offset = 1 << 19;
    static std::int64_t cell_of(std::int64_t x, std::int64_t y, std::int64_t z) {
        return (z << 40) + (y << 20) + x;
    }
    static std::size_t bucket(std::int64_t cell) {
        return scramble(static_cast<std::uint64_t>(cell)) % num_buckets;
    }

    static constexpr std::size_t num_buckets = 1 << 15;
    const Grains& grains_;
    std::size_t up_;
    std::vector<Vector> forces_;
    std::vector<std::int64_t> cells_;
    std::vector<int> next_;  ///< next grain in the same bucket, or -1
    std::vector<int> heads_ = std::vector<int>(num_buckets, -1);
};

}  // namespace

void move(Grains& grains, double time) {
    const auto steps = std::lround(time / time_step);
    for (long step = 0; step < steps; ++step) {
        const Step now(grains);
        for (std::size_t i = 0; i < grains.x.size(); ++i) {
            grains.v[i] = added(grains.v[i], time_step, now.forces()[i]);
            grains.x[i] = added(grains.x[i], time_step, grains.v[i]);
        }
    }
}

}  // namespace comparisons
