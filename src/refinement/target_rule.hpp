#pragma once

#include "cuts/tree.hpp"
#include "refinement/cut_search.hpp"

#include <span>

namespace rrcb {

/// Rule for what belongs below each cut of the tree, and how far from it a cut may end.
struct TargetRule {
    std::span<const double> part_sizes;
    double tolerance = 1;        ///< of the imbalance of all parts
    double common_weight = 0;    ///< weight of each point where all weigh the same, else 0
    double weight_per_size = 0;  ///< weight that a part of size 1 is to have
    bool is_exact = false;       ///< no slack but half a point

    std::span<const double> sizes_of(const Descent& at) const {
        return part_sizes.subspan(static_cast<std::size_t>(at.first_part),
                                  static_cast<std::size_t>(at.num_parts));
    }

    /// Share of a node's weight that belongs below its cut.
    double share_below(const Descent& at) const;

    /// Target of a node's cut, by what the node was counted to weigh.
    CutTarget target_of(const Descent& at, double weight) const;
};

}  // namespace rrcb
