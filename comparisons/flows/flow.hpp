#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace comparisons {

/// Particles whose positions are defined at each call of a balancer.
struct Flow {
    std::string name;
    int dimension = 2;
    std::size_t num_points = 0;
    std::size_t num_calls = 0;
    double spacing = 1;  ///< mean distance of particles where they are densest at the start
    /// Returns the interleaved positions of all particles at a call, in the order of their numbers.
    std::function<std::vector<double>(std::size_t)> positions{};
};

/// Returns the names of all flows, in the order of their table. Not collective.
std::vector<std::string> flow_names();

/// Returns a flow of 6,000 to 10,000 particles and 80 to 120 calls. It is bit-identical in each
/// run. Not collective. Throws Failure for an unknown name.
Flow make_flow(const std::string& name);

}  // namespace comparisons
