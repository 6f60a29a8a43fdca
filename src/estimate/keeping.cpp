#include "estimate/keeping.hpp"

#include "cuts/cut_limits.hpp"
#include "options/call_kind.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

bool reads_kept_tree(const Options& options, int num_ranks) {
    // As many as rank 0 divides by default.
    return num_ranks > 1 && num_ranks <= Tuning{}.central_parts && options.num_parts == num_ranks &&
           options.refine != Refine::exact && !are_cuts_limited(options);
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
    // A search finds the best imbalance. An estimate depends on chance.
    return gains && (is_half || (kept > tolerance && is_refined(options)));
}

bool may_be_poor(double imbalance, double least, const Options& options) {
    constexpr double factor = 1.25;
    return is_refined(options) && !are_cuts_limited(options) &&
           std::isgreater(imbalance, factor * std::max(options.imbalance_tolerance, least));
}

}  // namespace rrcb
