#pragma once

#include <mpm/scene.hpp>

#include <string>
#include <vector>

namespace mpm {

/// Returns the largest stable Courant number, in steps of 0.1. It depends on the shape function.
/// Stable means that rotating elastic discs of 2 to 6 points along a cell gain no energy, with and
/// without the cure of locking.
double stable_courant_number(const Scene& scene);

/// Returns a warning, with a fix, for each value of a scene that is probably a mistake.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace mpm
