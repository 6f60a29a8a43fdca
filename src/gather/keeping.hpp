#pragma once

#include <rrcb/options.hpp>

namespace rrcb {

/// True when points may stay in the parts that the ranks hold, one each. `options` are complete.
bool may_keep_parts(const Options& options, int num_ranks);

/// True when the root is to read where the points of each rank lie and what they weigh. It can then
/// tell whether they already lie as it would have them, of ranks that are not too many.
bool reads_kept_tree(const Options& options, int num_ranks);

/// True for the imbalance of a distribution so good that no better one is searched.
bool keeps_at_once(double kept, double tolerance);

/// True when parts of the imbalance `offered` are worth moving points that lie in parts of the
/// imbalance `kept`.
///
/// So points at rest come to rest. Each move makes the imbalance less: by a tenth of what the
/// tolerance allows, or from above the tolerance to within it. Points that are not moved give the
/// same estimate again.
bool is_worth_moving(double kept, double offered, const Options& options);

}  // namespace rrcb
