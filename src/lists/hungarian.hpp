#pragma once

#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Number of parts up to which the largest sum is found; beyond it would take too long.
inline constexpr int most_parts_exact = 128;

/// Gain of giving a part a number; both in 0 ... num_parts - 1.
struct Gain {
    Part part = 0;
    Part number = 0;
    GlobalCount value = 0;
};

/// A number for each part, every number once, with the largest sum of gains.
///
/// The largest up to `most_parts_exact`, beyond that at least half of it. Gains of one pair add up.
/// Among equals parts keep their number where they can. The order of `gains` does not matter.
std::vector<Part> best_numbers(std::span<const Gain> gains, int num_parts);

}  // namespace rrcb
