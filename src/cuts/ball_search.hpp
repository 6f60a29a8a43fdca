#pragma once

#include "cuts/ball.hpp"
#include "cuts/owned_cuts.hpp"
#include "cuts/packed_tree.hpp"
#include "cuts/part_reaches.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

namespace rrcb {

/// Finds the parts whose closed region a ball touches, except some. An empty region is never
/// touched.
class BallSearch {
  public:
    /// Leaves out the parts in `ranges`, which ascend. `cuts` and `reaches` outlive the search.
    /// With `reaches` it also finds the parts that need the centre.
    BallSearch(const Cuts& cuts, std::span<const PartRange> ranges,
               const PartReaches* reaches = nullptr)
        : dimension_(cuts.dimension),
          tree_(cuts,
                [&](Part part, const Box& region) {
                    return is_in(ranges, part) || is_region_empty(cuts, part, region) ? left_out
                                                                                      : part;
                }),
          reaches_(reaches) {
        if (reaches != nullptr) find_reaches();
    }

    /// Calls visit(part), and lack(node) for nodes whose cut is unknown, both ascending. Time:
    /// these calls times the depth of the tree. `apart` are the distances from the centre to the
    /// box that limits all regions.
    template <class Visit, class Lack>
    void for_each_part(const Ball& ball, Visit&& visit, Lack&& lack,
                       const Vector& apart = {}) const {
        descend(0, ball, apart, visit, lack);
    }

  private:
    static bool is_in(std::span<const PartRange> ranges, Part part) {
        const auto next = std::ranges::upper_bound(ranges, part, {}, &PartRange::first);
        return next != ranges.begin() && part < std::prev(next)->end;
    }

    /// `apart` are the distances from the centre to the region of the node along the axes.
    template <class Visit, class Lack>
    void descend(std::int32_t node, const Ball& ball, const Vector& apart, Visit&& visit,
                 Lack&& lack) const {
        if (!(reaches_ ? ball.widened(greatest_[node]) : ball).touches(apart, dimension_)) return;
        if (tree_.is_end(node)) {
            const Part entry = tree_.entry_at(node);
            if (entry == left_out) return;
            if (is_unknown(entry)) return lack(unknown_node(entry));
            if (!reaches_ || reaches_->reaches(entry, ball)) visit(entry);
            return;
        }
        const int axis = tree_.axis_of(node);
        const double plane = tree_.plane_of(node);
        Vector below = apart;
        Vector above = apart;
        below[axis] = std::max(apart[axis], ball.centre()[axis] - plane);
        above[axis] = std::max(apart[axis], plane - ball.centre()[axis]);
        descend(tree_.lower_of(node), ball, below, visit, lack);
        descend(tree_.lower_of(node) + 1, ball, above, visit, lack);
    }

    /// Notes the greatest reach at or below each node; nodes follow the ones above them.
    void find_reaches() {
        const double of_all = reaches_->greatest();
        greatest_.resize(tree_.num_nodes());
        for (std::int32_t node = tree_.num_nodes(); node-- > 0;) {
            const std::int32_t lower = tree_.lower_of(node);
            if (!tree_.is_end(node)) {
                greatest_[node] = std::max(greatest_[lower], greatest_[lower + 1]);
                continue;
            }
            const Part entry = tree_.entry_at(node);
            greatest_[node] = entry == left_out   ? -infinity
                              : is_unknown(entry) ? of_all
                                                  : reaches_->of(entry);
        }
    }

    int dimension_;
    PackedTree tree_;
    const PartReaches* reaches_;
    std::vector<double> greatest_{};  ///< reach of the parts at or below each node
};

}  // namespace rrcb
