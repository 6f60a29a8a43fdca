#pragma once

#include "zoltan/handle/frame.hpp"
#include "zoltan/handle/part_map.hpp"

#include <rrcb/cuts.hpp>

#include <array>
#include <vector>

namespace rrcb::zoltan {

/// One cut of Zoltan_RCB_Partition_Tree: nodes by number, parts as the negative of theirs.
struct TreeNode {
    int parent = 0;  ///< number + 1, negative for a node above its parent's cut
    int lower = 0;
    int upper = 0;
};

/// The last partition as look-ups and the next one need it, laid out for look-ups.
class KeptPartition {
  public:
    /// Room for the cuts between so many parts.
    explicit KeptPartition(std::size_t num_parts);

    /// Keeps the cuts, which cross the axes of `frame`, without asking for memory; `numbers` is the
    /// new number of each part.
    void keep(Cuts&& cuts, const Frame& frame, PartMap&& map, std::vector<Part>&& numbers) noexcept;

    /// Without KEEP_CUTS, or what implies it, cuts are kept for the next partition only.
    void answer_look_ups(bool answers) { answers_look_ups_ = answers; }
    bool answers_look_ups() const { return answers_look_ups_; }

    const Cuts& cuts() const { return cuts_; }
    const Frame& frame() const { return frame_; }
    const PartMap& map() const { return map_; }
    const std::vector<Part>& numbers() const { return numbers_; }

    /// Of positions in look-ups, before they are placed in the frame.
    int dimension() const { return frame_.turns() ? frame_.dimension : cuts_.dimension; }

    /// Part of a position, one coordinate per dimension.
    Part part_of(const double* coordinates) const;

    /// Writes the parts a closed box touches, ascending; returns how many. `parts` has room for
    /// all. A box that is turned to the frame may touch more.
    int parts_touching(const Box& box, Part* parts) const;

    /// Region of a part along the axes of the frame, open sides +-infinity.
    Box region_of(Part part) const;

    /// Node 1 ... parts - 1 of the tree; node 0 stands above the root. In the numbers before they
    /// were changed, as Zoltan has it.
    const TreeNode& tree_node(int node) const { return tree_[static_cast<std::size_t>(node)]; }

  private:
    /// Index k is cut k; children below 0 are parts, the part p as ~p.
    struct Node {
        double plane = 0;
        std::int32_t axis = 0;
        std::array<std::int32_t, 2> child{};  ///< below the cut, above it
    };

    std::int32_t build(Part first_part, int num_parts, int parent);
    Part descend(const double* position) const;
    bool is_above(std::size_t cut, const double* position) const;
    int collect(std::int32_t at, const Box& box, Part* parts, int count) const;

    Cuts cuts_;
    Frame frame_;
    PartMap map_;
    std::vector<Part> numbers_;
    std::vector<Part> boxes_;  ///< which box has the number
    std::vector<Node> nodes_;
    std::vector<TreeNode> tree_;
    std::int32_t root_ = 0;
    bool answers_look_ups_ = true;
};

}  // namespace rrcb::zoltan
