#pragma once

#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Returns sizes of the parts for the next call of balance() that make the loads of the parts more
/// even: a part whose load is above the mean gets a smaller size. Not collective.
///
/// Use it if parts have a cost that no weight of a point contains, such as the cost of their
/// ghosts. Assign the result to Options::part_sizes, and pass the cuts of the last call. Two or
/// three calls are enough; call it again when the loads change.
/// @param loads      of each part in the last step, in any unit, such as points + 0.25 * ghosts
/// @param part_sizes those of the last call; empty: equal parts
/// @return one size for each part, with the same sum: size * (mean load / load)^0.7, at least half
/// and at most twice the size before; parts without load or of size 0 keep their size
/// Throws Error if a load is negative or not finite, or if the number of sizes is not that of the
/// loads.
[[nodiscard]] RRCB_API std::vector<double> balanced_sizes(std::span<const double> loads,
                                                          std::span<const double> part_sizes = {});

}  // namespace rrcb
