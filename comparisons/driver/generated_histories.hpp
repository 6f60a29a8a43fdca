#pragma once

#include "load_history.hpp"

#include <cstdint>
#include <vector>

namespace comparisons {

/// A history of each kind: growth, jumps, oscillation, noise and so on, the same for a seed.
///
/// The mean load is about 1, a rebalance costs 0.3 to 20.
std::vector<LoadHistory> generated_histories(std::uint64_t seed);

}  // namespace comparisons
