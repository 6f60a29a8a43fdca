#pragma once

#include "cuts/packed_tree.hpp"
#include "zoltan/handle/numbering.hpp"
#include "zoltan/handle/part_map.hpp"

#include <rrcb/cuts.hpp>

#include <cstddef>

namespace rrcb::zoltan {

/// One cut of Zoltan_RCB_Partition_Tree. A child is the number of a node, or the negative number of
/// a part.
struct TreeNode {
    int parent = 0;  ///< number of the parent + 1; negative if this node is above the parent's cut
    int lower = 0;
    int upper = 0;
};

/// The last partition, for look-ups and as start of the next partition.
class LastPartition {
  public:
    /// Reserves memory for look-ups by all cuts between this many parts; 0 means that there will be
    /// no look-ups.
    explicit LastPartition(std::size_t num_parts) { tree_.reserve(num_parts); }
    LastPartition(LastPartition&&) = default;
    LastPartition& operator=(LastPartition&&) = default;

    /// Returns a copy, in which look-ups are as fast as in the original. Throws std::bad_alloc.
    LastPartition copy() const;

    /// Keeps the cuts without allocating memory.
    void keep(Cuts&& cuts, PartMap&& map, Numbering&& numbering) noexcept;

    /// Sets whether look-ups may use the cuts; at first they may not. Without KEEP_CUTS, or a
    /// parameter that implies it, the cuts are only for the next partition.
    void answer_look_ups(bool answers) noexcept {
        answers_look_ups_ = answers;
        if (answers) prepare_look_ups();
    }
    bool answers_look_ups() const { return answers_look_ups_; }

    /// Returns the cuts from which the next partition may start.
    const Cuts& cuts() const { return cuts_; }

    const PartMap& map() const { return map_; }
    const Numbering& numbering() const { return numbering_; }

    /// Prepares part_of() and parts_touching(), without allocating memory.
    void prepare_look_ups() noexcept;

    /// Returns the part of a position, one coordinate per dimension.
    Part part_of(const double* coordinates) const {
        return tree_.entries()[tree_.end_of(coordinates)];
    }

    /// Writes the parts that a closed box touches, in ascending order, and returns their number.
    /// `parts` must have room for all parts.
    int parts_touching(const Box& box, Part* parts) const;

    /// Returns the region of a part; open sides are +-infinity.
    Box region_of(Part part) const {
        return rrcb::region_of(cuts_, end_of(cuts_, numbering_.box_of(part)));
    }

    /// Returns a node of the tree. The cuts are nodes 1 to parts - 1; node 0 is above the root.
    /// Numbers of parts are those before REMAP, as in Zoltan.
    TreeNode tree_node(int node) const;

  private:
    Cuts cuts_;
    PartMap map_;
    Numbering numbering_;
    PackedTree tree_;  ///< the cuts with the numbers of the parts; empty until look-ups need it
    bool answers_look_ups_ = false;
};

}  // namespace rrcb::zoltan
