#pragma once

#include <rrcb/options.hpp>

namespace rrcb {

/// Whether the root is to know where the points of each rank lie, and what they weigh: it can then
/// tell whether they already are as it would have them. Of complete options.
bool reads_current_parts(const Options& options, int num_ranks);

/// True for a distribution so good that nothing better is looked for.
bool stays_at_once(double current, double tolerance);

/// True when parts of the imbalance `offered` are worth moving points that lie in parts of the
/// imbalance `current`.
///
/// So points at rest come to rest: each move makes the imbalance less, by a tenth of what the
/// tolerance allows or from above the tolerance to within it, and what is not moved gives the same
/// estimate again.
bool is_worth_moving(double current, double offered, const Options& options);

}  // namespace rrcb
