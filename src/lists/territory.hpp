#pragma once

#include "cuts/packed_tree.hpp"
#include "lists/near_boxes.hpp"
#include "lists/part_reaches.hpp"
#include "lists/periodic_images.hpp"
#include "lists/quiet_boxes.hpp"
#include "lists/radii.hpp"

#include <rrcb/neighbours.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rrcb {

/// The parts of this rank, and the parts near them. Parts are regions of cuts, or boxes.
class Territory {
  public:
    /// Copies the cuts. Throws Error if the cuts or options are not valid.
    Territory(const Cuts& cuts, const NeighbourOptions& options, int rank, int num_ranks);
    /// Copies the boxes of the parts. Throws Error for boxes or options that are not valid.
    Territory(std::span<const Box> boxes, int dimension, const NeighbourOptions& options, int rank,
              int num_ranks);
    Territory(const Territory&) = delete;
    Territory& operator=(const Territory&) = delete;

    int dimension() const { return cuts_.dimension; }
    int num_parts() const { return cuts_.num_parts; }
    const PeriodicImages* images() const { return images_ ? &*images_ : nullptr; }
    int rank() const { return rank_; }

    /// Returns the ends of the tree, or the boxes, whose parts are on this rank and have a region,
    /// in ascending order.
    std::span<const Part> ends() const { return ends_; }

    /// Returns the other ranks with parts within reach of those of this rank, ascending.
    std::vector<int> near_ranks() const;

    /// Returns the regions near this rank's points. `reaches` may be null.
    NearBoxes near_boxes(const PartReaches* reaches) const;

    /// Calls visit(i) for each point that may be outside this rank's parts, in ascending order.
    template <class Visit>
    void for_each_outside(const Points& points, Visit&& visit) const {
        inside_->for_each_outside(points, visit);
    }

    /// Returns the rank that owns a position. If several ranks may own it, prefers this rank.
    /// Returns -1 for a position in none of the boxes.
    int owner_of(const Vector& position) const;

    /// Notes the reaches of this rank's points. A point outside all parts of this rank counts for
    /// each of them.
    void note_reaches(const Points& points, const Radii& radii, PartReaches& reaches) const;

    /// Returns whether a position is in a region of this rank or on its boundary.
    bool is_at_home(const Vector& position) const;

    /// Returns whether a point is so near the regions of this rank that only neighbours can need it
    /// within this radius.
    bool is_within_reach(const Vector& position, double radius) const;

    /// Throws Error if the point is not finite or outside the periodic box.
    void check_position(const Points& points, LocalIndex point) const;

    /// Returns "point I (the first is 0) at (X, Y)".
    std::string name_of(const Points& points, LocalIndex point) const;

  private:
    void check(const NeighbourOptions& options);
    RankRange ranks_of_end(Part end) const;
    void find_regions();
    void add_region(Part end, const Box& region);
    NearBoxes near(const Box& points, const PartReaches* reaches) const;
    Part end_at(const Vector& position) const;
    int owner_by_boxes(const Vector& position) const;

    Cuts cuts_;               ///< without a tree if there are boxes
    std::vector<Box> boxes_;  ///< of all parts
    std::vector<RankRange> ranks_of_parts_;
    bool has_ranks_;
    int rank_;
    int num_ranks_;
    double reach_;
    std::optional<PeriodicImages> images_{};
    std::vector<Part> ends_{};
    std::vector<Box> regions_{};      ///< regions of these ends
    Box all_{};                       ///< box around all regions
    std::vector<Part> near_parts_{};  ///< parts of other ranks whose boxes are near these
    PackedTree tree_;
    std::optional<QuietBoxes> inside_{};
};

}  // namespace rrcb
