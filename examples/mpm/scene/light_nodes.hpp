#pragma once

#include <mpm/scene.hpp>

namespace mpm {

/// What keeps explicit steps stable, on heavy nodes and on light ones.
struct StepRule {
    double wave_speed = 0;      ///< the largest of the materials, m/s
    double courant_number = 0;  ///< of the scene, or the largest that is stable
    double least_weight = 0;    ///< that a point has on any of its nodes, along each axis
};

/// Returns the rule of a scene.
///
/// A node that only the rims of points reach is light, but as stiff as others. The least weight
/// keeps the square of the highest frequency of a point by itself at 2 per step or less, and with
/// it that of all points together: docs/method.md derives it. If even the largest weight of its
/// shape functions is too small, the steps become shorter.
StepRule rule_for(const Scene& scene);

}  // namespace mpm
