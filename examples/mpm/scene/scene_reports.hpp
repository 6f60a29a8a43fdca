#pragma once

#include <mpm/scene.hpp>

#include <string>
#include <vector>

namespace mpm {

/// Largest Courant number at which elastic disks of 2 to 6 points along a cell, with and without
/// the cure of locking, turn without gaining energy, by the shape function, in steps of 0.1.
double stable_courant_number(const Scene& scene);

/// Values of a scene that may not be meant, each with a fix.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace mpm
