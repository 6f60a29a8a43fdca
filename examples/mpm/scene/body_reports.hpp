#pragma once

#include <mpm/scene.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace mpm {

/// What of a body its points stand for.
struct BodyReport {
    std::string name;
    std::int64_t num_points = 0;
    double mass = 0;        ///< of its points, kg; per metre of depth in two dimensions
    double asked_mass = 0;  ///< of its shapes, those outside the grid included, to about 0.3 %
    std::string warning;    ///< with the place and a fix, where the two differ by more than 2 %
};

/// A report on each body of a scene that keeps the rules, in their order. Not collective.
///
/// Where the bounds of a body are open, only what lies in the grid is asked for.
std::vector<BodyReport> report_on_bodies(const Scene& scene);

}  // namespace mpm
