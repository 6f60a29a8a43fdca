#pragma once

#include <rrcb/points.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace comparisons {

struct Particle;

/// Particles whose positions are defined at each call of a balancer.
struct Flow {
    const char* name;
    int dimension;
    std::size_t num_points;
    std::size_t num_calls;
    double spacing;  ///< mean distance of particles where they are densest at the start
    rrcb::Vector (*position)(Particle&, double time);  ///< the time is from 0 to 1

    /// Returns the interleaved positions of all particles at a call, in the order of their numbers.
    std::vector<double> positions(std::size_t call) const;
};

/// Returns the names of all flows, in the order of their table. Not collective.
std::vector<std::string> flow_names();

/// Returns a flow of 6,000 to 10,000 particles and 80 to 120 calls. It is bit-identical in each
/// run. Not collective. Throws Failure for an unknown name.
const Flow& make_flow(const std::string& name);

}  // namespace comparisons
