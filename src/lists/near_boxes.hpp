#pragma once

#include "lists/ball.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/plan.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace rrcb {

class PartReaches;
class PeriodicImages;

/// Points of this rank, and the holders of parts.
struct NearRequest {
    std::function<RankRange(Part end)> ranks_of;  ///< of the part at an end of the tree
    int rank;                                     ///< this one
    Box points;                                   ///< contains the points of this rank
    double radius;                                ///< greatest of them; below 0: none counts
    const PeriodicImages* images = nullptr;       ///< valid ones, or null
    const PartReaches* reaches = nullptr;         ///< of all parts if their radii count, or null
};

/// Regions of parts within reach of this rank's points, in a flat list in place of the tree of
/// cuts.
///
/// Without images it lacks the parts that only this rank holds. Parts that no position belongs to
/// are always left out. Regions are clipped to the periodic box. In a long list rows for several
/// regions precede these: balls that miss such a row skip them.
class NearBoxes {
  public:
    struct Row {
        Box box;
        double reach = 0;             ///< of the part, see Ball::reach_of(); -infinity: none
        Part end = no_part;           ///< of the tree; no_part in a row for several regions
        std::int32_t num_below = 0;   ///< of the rows that follow, those for these regions
        std::int32_t first_slot = 0;  ///< the part's ranks are consecutive entries of ranks()
        std::int32_t num_slots = 0;
    };

    /// Lists the regions. Throws std::bad_alloc. Time: for the cuts and parts within reach of the
    /// box of the points.
    NearBoxes(const Cuts& cuts, const NearRequest& request);

    /// Calls visit(row) for each region that a ball touches, or that lies within the reach of its
    /// part from the centre, by ascending ends. The ball is one of the points or their images.
    template <int dimension, class Visit>
    void for_each_touched(const Ball& ball, Visit&& visit) const {
        const Row* const end = rows_.data() + rows_.size();
        for (const Row* row = rows_.data(); row != end; ++row) {
            if (!ball.touches(row->box, row->reach, dimension)) {
                row += row->num_below;
            } else if (row->end != no_part) {
                visit(*row);
            }
        }
    }

    /// Returns all ranks of the listed parts, in ascending order.
    const std::vector<int>& ranks() const { return ranks_; }

    /// Returns boxes of which only this rank holds all parts; they do not overlap.
    const std::vector<Box>& homes() const { return homes_; }

  private:
    friend class NearList;

    std::vector<Row> rows_;
    std::vector<int> ranks_;
    std::vector<Box> homes_;
};

}  // namespace rrcb
