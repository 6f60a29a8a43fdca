#pragma once

#include "options/axis_order.hpp"

#include <rrcb/options.hpp>

#include <algorithm>

namespace rrcb {

/// Returns true if the options limit the positions of cuts, by min_width or a grid.
inline bool are_cuts_limited(const Options& options) {
    return !options.expert.axes.min_width.empty() || !options.expert.axes.grid.empty();
}

/// Returns true if the cuts are refined by counting the points of all ranks.
inline bool is_refined(const Options& options) {
    return options.refine != Refine::none;
}

/// Returns true if many ranks make the parts, see ExpertOptions::max_root_parts. The options must
/// be complete.
inline bool is_spread(const Options& options, int num_ranks) {
    return std::min(options.num_parts, num_ranks) > options.expert.max_root_parts &&
           is_refined(options) && !is_grouped(options.expert.axes.order) &&
           !are_cuts_limited(options);
}

}  // namespace rrcb
