#pragma once

#include "cuts/tree.hpp"
#include "search/cut_search.hpp"

#include <limits>
#include <span>

namespace rrcb {

inline constexpr double not_counted = -1;

/// Rule for what belongs below each cut of the tree, and how far from it a cut may end.
///
/// Where cuts are `earlier` ones, each moves as little as lets all parts be within the tolerance,
/// so that few points change parts; otherwise to the share of the parts below it.
struct TargetRule {
    std::span<const double> part_sizes;
    double tolerance = 1;        ///< of the imbalance of all parts
    double common_weight = 0;    ///< weight of each point where all weigh the same, else 0
    double heaviest = 0;         ///< weight of the heaviest point
    double weight_per_size = 0;  ///< weight that a part of size 1 is to have
    double counted_weight = 0;   ///< of all parts, where these were counted
    bool is_exact = false;       ///< no slack but half a point
    bool is_earlier = false;     ///< the cuts are those of an earlier call, not limited

    std::span<const double> sizes_of(const Descent& at) const {
        return part_sizes.subspan(at.first_part, at.num_parts);
    }

    /// Share of a node's weight that belongs below its cut.
    double share_below(const Descent& at) const;

    /// Whether the parts of a node weigh no more than the tolerance allows. `part_weights` has one
    /// entry per part of the whole tree.
    bool are_within(const Descent& at, std::span<const double> part_weights) const;

    /// Whether the tolerance leaves the smallest part room for several of the heaviest points, so
    /// that cuts can be told by weights in bins.
    bool are_points_light() const;

    /// Whether a cut may stay where it is: each side either is within the tolerance or weighs so
    /// little that cuts below can bring it there.
    bool may_stay(const Descent& at, std::span<const double> part_weights) const;

    /// Target of a node's cut, by what the node was counted to weigh, and what of it lies below
    /// its cut as it is, where that was counted.
    CutTarget target_of(const Descent& at, double weight, double below = not_counted) const;

  private:
    double most_weight(const Descent& at) const;
    CutTarget nearest_target(const Descent& at, double weight, double below) const;
};

/// What the parts of a node weigh together.
double weight_of(const Descent& at, std::span<const double> part_weights);

}  // namespace rrcb
