#pragma once

#include <rrcb/options.hpp>

namespace rrcb {

/// Returns true if points may be kept in the parts that the ranks hold, one each: rank 0 then reads
/// the extents and weights of the points of all ranks. Only up to some number of ranks, and without
/// limits of cuts. `options` are complete.
bool reads_kept_tree(const Options& options, int num_ranks);

/// Returns true if no better parts are searched for.
bool keeps_at_once(double kept, double tolerance);

/// Returns true if parts of the imbalance `offered` are worth moving points out of parts of the
/// imbalance `kept`.
///
/// Points that do not move are therefore kept after a few calls. Each call that moves points
/// reduces the imbalance: by a twentieth of (tolerance - 1), or from above the tolerance to within
/// it.
bool is_worth_moving(double kept, double offered, const Options& options);

/// Returns true if parts from earlier cuts are so uneven, although `least` is possible, that the
/// axes of these cuts, which are kept, may be why.
bool may_be_poor(double imbalance, double least, const Options& options);

}  // namespace rrcb
