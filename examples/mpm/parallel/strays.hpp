#pragma once

#include <mpm/particles.hpp>
#include <mpm/scene.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace mpm {

/// Finds the points that have crossed the sides of a grid. They leave it through open walls.
class Strays {
  public:
    Strays(const GridShape& grid, const Walls& walls);

    /// Removes the points that have left through open sides. Puts a point beyond a closed side back
    /// to where a mirror would have sent it. Not collective.
    ///
    /// @param home a box within the grid
    /// @return whether a point that stays is outside `home`
    /// Throws std::runtime_error, which names the first point without a finite position. `now` is
    /// for its text.
    template <int D>
    bool remove(const Box& home, const MotionColumns& motion, double now, Particles& particles);

  private:
    template <int D>
    bool stays(const MotionColumns& motion, std::size_t point, Particles& particles) const;

    Box grid_;
    std::array<std::array<bool, 2>, 3> is_open_;  ///< by axis: the lower and the upper side
    std::vector<std::size_t> lost_;
};

/// Returns whether all points are in a closed box.
template <int D>
bool are_inside(const Box& box, const Particles& particles, const MotionColumns& motion);

}  // namespace mpm
