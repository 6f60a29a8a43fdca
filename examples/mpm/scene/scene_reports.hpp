#pragma once

#include <mpm/scene.hpp>

#include <string>
#include <vector>

namespace mpm {

/// Largest Courant number at which an elastic beam of 2 or 3 points along a side of a cell vibrates
/// without gaining energy, by the shape function of a scene, in steps of 0.1.
double stable_courant_number(const Scene& scene);

/// Values of a scene that may not be meant, each with a fix.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace mpm
