#pragma once

#include "lists/ball.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/plan.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rrcb {

class PartReaches;
class PeriodicImages;

/// Returns the box that two boxes have in common; its bounds are reversed if there is none.
Box common(const Box& a, const Box& b);

/// Returns true if a closed box contains no position.
bool is_empty(const Box& box, int dimension);

/// Points of this rank, and the ranks that hold each part.
struct NearRequest {
    std::function<RankRange(Part end)> ranks_of;  ///< ranks with the part at an end of the tree
    int rank;                                     ///< number of this rank
    Box points;                                   ///< contains the points of this rank
    double radius;  ///< largest radius of the points; negative if their radii do not count
    const PeriodicImages* images = nullptr;  ///< checked images, or null
    const PartReaches* reaches = nullptr;    ///< reaches of all parts if these count, or null
};

/// Regions of parts within reach of this rank's points, as a flat list that replaces the tree of
/// cuts.
///
/// Without images the list lacks parts that only this rank holds. It always lacks parts without any
/// position. Regions are clipped to the periodic box. In a long list, a common row for several
/// regions precedes their rows, so that balls which do not touch it skip them all.
class NearBoxes {
  public:
    struct Row {
        Box box;
        double reach = 0;    ///< reach of the part, see Ball::reach_of(); -infinity if it has none
        Part end = no_part;  ///< end of the tree; no_part in a common row
        std::int32_t num_below = 0;   ///< number of following rows that a common row precedes
        std::int32_t first_slot = 0;  ///< ranks of the part: num_slots entries of ranks() from here
                                      ///< on
        std::int32_t num_slots = 0;
    };

    /// Lists the regions. Throws std::bad_alloc. The time is proportional to the number of cuts and
    /// parts within reach of the box of the points.
    NearBoxes(const Cuts& cuts, const NearRequest& request);

    /// Lists the boxes near this rank's points, of the boxes of all parts; the end of a row is the
    /// number of its part. Boxes may overlap: homes() contains those of this rank that no box of
    /// another rank overlaps. Throws std::bad_alloc.
    NearBoxes(std::span<const Box> boxes, int dimension, const NearRequest& request);

    /// Calls visit(row) for each region that the ball touches, or whose part reaches the centre, in
    /// ascending order of ends. The ball must be that of a point of this rank or an image of it.
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

    const std::vector<Row>& rows() const { return rows_; }

    /// Returns boxes of which only this rank holds all parts; they do not overlap.
    const std::vector<Box>& homes() const { return homes_; }

  private:
    friend class NearList;

    std::vector<Row> rows_;
    std::vector<int> ranks_;
    std::vector<Box> homes_;
};

}  // namespace rrcb
