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

/// Largest Courant number at which an elastic beam of 2 or 3 points along a side of a cell vibrates
/// without gaining energy, by the shape function and transfer of a scene, in steps of 0.1.
double stable_courant_number(const Scene& scene);

/// Values of a scene that may not be meant, each with a fix: a Courant number beyond the stable
/// one, frictional soil that locks, numbers that look as if in other units, probes far from points.
std::vector<std::string> scene_warnings(const Scene& scene);

/// The damping that the method of a scene adds to its materials: what flip_fraction leaves out is a
/// viscosity of (1 - flip_fraction) * density * wave speed * cell size. None with 1.
std::vector<std::string> damping_notes(const Scene& scene);

}  // namespace mpm
