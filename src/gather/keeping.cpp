#include "gather/keeping.hpp"

#include "cuts/cut_limits.hpp"
#include "options/call_kind.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

bool may_keep_parts(const Options& options, int num_ranks) {
    return options.refine != Refine::exact && num_ranks > 1 && options.num_parts == num_ranks;
}

bool reads_kept_tree(const Options& options, int num_ranks) {
    // As many as rank 0 divides by default.
    return num_ranks <= Tuning{}.central_parts && may_keep_parts(options, num_ranks);
}

bool keeps_at_once(double kept, double tolerance) {
    return kept - 1 <= (tolerance - 1) / 10;
}

bool is_worth_moving(double kept, double offered, const Options& options) {
    // NaN, if nothing was counted, raises no exception in these comparisons.
    constexpr double rounding = 1e-12;
    const double tolerance = options.imbalance_tolerance;
    if (kept > tolerance && std::islessequal(offered, tolerance)) return true;
    const bool gains = std::isgreater(kept - offered, std::max((tolerance - 1) / 20, rounding));
    const bool is_half = std::islessequal(offered - 1, (kept - 1) / 2);
    // A search finds the best imbalance. An estimate, and the axes of limited cuts, depend on
    // chance.
    const bool was_searched =
        kept > tolerance && options.refine != Refine::none && !are_cuts_limited(options);
    return gains && (is_half || was_searched);
}

bool may_be_poor(double imbalance, double least, const Options& options) {
    constexpr double factor = 1.25;
    return is_refined(options) && !are_cuts_limited(options) &&
           std::isgreater(imbalance, factor * std::max(options.imbalance_tolerance, least));
}

}  // namespace rrcb
