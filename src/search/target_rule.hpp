#pragma once

#include "cuts/tree.hpp"
#include "search/cut_search.hpp"

#include <limits>
#include <span>

namespace rrcb {

/// Determines the target weight below each cut of the tree, from the share of the parts there, and
/// its slack.
struct TargetRule {
    std::span<const double> part_sizes{};  ///< size of each part; empty in a spread search: all
                                           ///< sizes are 1
    double tolerance = 1;                  ///< largest allowed imbalance of all parts
    double common_weight = 0;    ///< weight of each point if all have the same, otherwise 0
    double heaviest = 0;         ///< weight of the heaviest point
    double weight_per_size = 0;  ///< ideal weight of a part of size 1
    double counted_weight = 0;   ///< sum over all parts, if they were counted
    bool is_exact = false;       ///< whether the only slack is half a point

    /// Returns true if gathering the points of a node with this weight takes fewer numbers than a
    /// histogram.
    bool are_few(double weight) const {
        constexpr double few = 16;
        return common_weight == 1 && weight <= few;
    }

    /// Returns the sum of the sizes of a node's parts.
    double size_of(const Descent& at) const;

    /// Returns the share of a node's weight that should be below its cut.
    double share_below(const Descent& at) const;

    /// Returns whether all parts of a node are within the tolerance. `part_weights` has one entry
    /// for each part of the complete tree.
    bool are_within(const Descent& at, std::span<const double> part_weights) const;

    /// Returns whether the tolerance leaves room for the heaviest point, even in the smallest part.
    bool is_attainable() const;

    /// Returns whether a cut may be kept: the parts on each side are within the tolerance, or the
    /// side is light enough for cuts below to bring them within the tolerance.
    bool may_stay(const Descent& at, std::span<const double> part_weights) const;

    /// Returns the target of a node's cut, given the counted weight of the node.
    CutTarget target_of(const Descent& at, double weight) const;

    /// Returns the weight that is missing below a node's cut.
    double missing_below(const Descent& at, std::span<const double> part_weights) const;

    /// Returns the numbers of points below a node's cut with which all parts get points, if the
    /// node has `count` points of the total weight `weight`. If the parts have different sizes, any
    /// number is allowed, because an empty part may then be the most even choice.
    CountLimits count_limits(const Descent& at, GlobalCount count, double weight) const;

  private:
    std::span<const double> sizes_of(const Descent& at) const {
        return part_sizes.subspan(at.first_part, at.num_parts);
    }
    double smallest_weight(const Descent& at) const;
    double attainable_tolerance(const Descent& at) const;
    double most_weight(const Descent& at) const;
};

/// Returns the weight of all parts of a node.
double weight_of(const Descent& at, std::span<const double> part_weights);

}  // namespace rrcb
