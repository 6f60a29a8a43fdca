#pragma once

#include "cuts/tree.hpp"
#include "search/cut_search.hpp"

#include <limits>
#include <span>

namespace rrcb {

/// Rule for the weight below each cut of the tree, the share of the parts there, and for its slack.
struct TargetRule {
    std::span<const double> part_sizes{};  ///< one per part; empty: all 1, in a spread search
    double tolerance = 1;                  ///< of the imbalance of all parts
    double common_weight = 0;              ///< weight of each point if all weigh the same, else 0
    double heaviest = 0;                   ///< weight of the heaviest point
    double weight_per_size = 0;            ///< ideal weight of a part of size 1
    double counted_weight = 0;             ///< of all parts, if these were counted
    bool is_exact = false;                 ///< no slack but half a point

    /// Returns true if points of this weight are so few that a histogram has more numbers.
    bool are_few(double weight) const {
        constexpr double few = 16;
        return common_weight == 1 && weight <= few;
    }

    /// Returns the sum of the sizes of a node's parts.
    double size_of(const Descent& at) const;

    /// Returns the share of a node's weight to come below its cut.
    double share_below(const Descent& at) const;

    /// Returns whether the parts of a node weigh no more than the tolerance allows. `part_weights`
    /// has one entry per part of the whole tree.
    bool are_within(const Descent& at, std::span<const double> part_weights) const;

    /// Returns whether the smallest part may have any of the points more than it should.
    bool is_attainable() const;

    /// Returns whether a cut may be kept: each side is within the tolerance, or weighs so little
    /// that the cuts below can meet it.
    bool may_stay(const Descent& at, std::span<const double> part_weights) const;

    /// Returns the target of a node's cut, from the counted weight of the node.
    CutTarget target_of(const Descent& at, double weight) const;

    /// Returns the weight missing below a node's cut.
    double missing_below(const Descent& at, std::span<const double> part_weights) const;

    /// Returns the numbers of points below a node's cut that fill all parts, of `count` points that
    /// weigh `weight`. With parts of different sizes any number: an empty part may then be the most
    /// even.
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
