#pragma once

#include "cuts/packed_tree.hpp"
#include "zoltan/handle/numbering.hpp"
#include "zoltan/handle/part_map.hpp"

#include <rrcb/cuts.hpp>

#include <cstddef>

namespace rrcb::zoltan {

/// One cut of Zoltan_RCB_Partition_Tree. Its children are numbers of nodes, or negative ones of
/// parts.
struct TreeNode {
    int parent = 0;  ///< number + 1, negative for a node above its parent's cut
    int lower = 0;
    int upper = 0;
};

/// Last partition, for look-ups and for the next one.
class LastPartition {
  public:
    /// Reserves memory for look-ups by all cuts between so many parts, 0 if there will be none.
    explicit LastPartition(std::size_t num_parts) { tree_.reserve(num_parts); }
    LastPartition(LastPartition&&) = default;
    LastPartition& operator=(LastPartition&&) = default;

    /// Returns a copy, which look-ups do not slow down. Throws std::bad_alloc.
    LastPartition copy() const;

    /// Keeps the cuts without allocating memory.
    void keep(Cuts&& cuts, PartMap&& map, Numbering&& numbering) noexcept;

    /// Sets whether look-ups may use the cuts, which they may not at first. Without KEEP_CUTS, or a
    /// parameter that implies it, they are for the next partition only.
    void answer_look_ups(bool answers) noexcept {
        answers_look_ups_ = answers;
        if (answers) prepare_look_ups();
    }
    bool answers_look_ups() const { return answers_look_ups_; }

    /// Cuts for the next partition.
    const Cuts& cuts() const { return cuts_; }

    const PartMap& map() const { return map_; }
    const Numbering& numbering() const { return numbering_; }

    /// Makes part_of() and parts_touching() possible, without allocating memory.
    void prepare_look_ups() noexcept;

    /// Returns the part of a position, one coordinate per dimension.
    Part part_of(const double* coordinates) const {
        return tree_.entries()[tree_.end_of(coordinates)];
    }

    /// Writes the parts that a closed box touches, ascending. Returns their number. `parts` has
    /// room for all.
    int parts_touching(const Box& box, Part* parts) const;

    /// Returns the region of a part, open sides +-infinity.
    Box region_of(Part part) const {
        return rrcb::region_of(cuts_, end_of(cuts_, numbering_.box_of(part)));
    }

    /// Returns node 1 ... parts - 1 of the tree; node 0 is above the root. Its numbers are those
    /// before REMAP, as in Zoltan.
    TreeNode tree_node(int node) const;

  private:
    Cuts cuts_;
    PartMap map_;
    Numbering numbering_;
    PackedTree tree_;  ///< of the cuts, with the numbers of parts; empty until look-ups use it
    bool answers_look_ups_ = false;
};

}  // namespace rrcb::zoltan
