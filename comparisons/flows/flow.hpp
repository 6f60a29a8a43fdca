#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace comparisons {

/// Particles whose positions are known at each call of a balancer.
struct Flow {
    std::string name;
    int dimension = 2;
    std::size_t num_points = 0;
    std::size_t num_calls = 0;
    double spacing = 1;  ///< mean, where the particles are densest at first
    /// Returns the interleaved positions of all particles at a call, in the order of their numbers.
    std::function<std::vector<double>(std::size_t)> positions{};
};

/// Names of all flows, in the order of their table. Not collective.
std::vector<std::string> flow_names();

/// Makes a flow of 6,000 to 10,000 particles and 80 to 120 calls: the same bits in each run. Not
/// collective. Throws Failure for an unknown name.
Flow make_flow(const std::string& name);

}  // namespace comparisons
