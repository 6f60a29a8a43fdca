#pragma once

#include <mpm/decomposition.hpp>
#include <mpm/particles.hpp>
#include <mpm/scene.hpp>

#include <cstdint>

namespace mpm {

/// Number and place of the points of a scene.
struct Extent {
    std::int64_t num_points = 0;
    Box box;  ///< empty without points
};

/// Extent of a scene. Throws std::invalid_argument that names a point whose velocity is not finite.
Extent extent_of(const Scene& scene);

/// Appends the scene's points that `rank` owns. Columns other than those of motion and `material`
/// start with their initial values.
void place_points(const Scene& scene, const Decomposition& decomposition, int rank,
                  const MotionColumns& motion, Particles& particles);

}  // namespace mpm
