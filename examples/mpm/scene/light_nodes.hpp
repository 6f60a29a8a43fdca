#pragma once

#include <mpm/scene.hpp>

namespace mpm {

/// The limits that keep explicit steps stable, for heavy and for light nodes.
struct StepRule {
    double wave_speed = 0;      ///< largest wave speed of the materials, m/s
    double courant_number = 0;  ///< that of the scene, or the largest that is stable
    double least_weight = 0;    ///< least weight of a point on each of its nodes, along each axis
};

/// Returns the limits for a scene.
///
/// A node that is reached only by the edges of points is light, but as stiff as the others. The
/// least weight bounds the square of the highest frequency of a single point by 2 per step. This
/// also bounds the frequency of all points together; docs/method.md derives it. If even the largest
/// weight that the shape function allows is too small, the steps are shortened.
StepRule rule_for(const Scene& scene);

}  // namespace mpm
