#pragma once

#include "zoltan/handle/numbering.hpp"
#include "zoltan/handle/part_map.hpp"

#include <rrcb/cuts.hpp>

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace rrcb::zoltan {

/// One cut of Zoltan_RCB_Partition_Tree. Its children are numbers of nodes, or negative ones of
/// parts.
struct TreeNode {
    int parent = 0;  ///< number + 1, negative for a node above its parent's cut
    int lower = 0;
    int upper = 0;
};

/// Last partition, for look-ups and for the next one.
class KeptPartition {
  public:
    /// Makes room for the cuts between so many parts, which may be spread over the ranks.
    explicit KeptPartition(std::size_t num_parts, bool are_spread = false);

    /// Keeps the cuts without asking for memory. If they are spread over the ranks, look-ups wait
    /// for show_all().
    void keep(Cuts&& cuts, PartMap&& map, Numbering&& numbering) noexcept;

    /// Gives look-ups all cuts in preorder, of their own or in memory that outlives them.
    void show_all(std::vector<Cut>&& tree) noexcept;
    void show_all(std::span<const Cut> shared) noexcept { shared_ = shared; }
    bool shows_all() const {
        return numbering_.is_whole() &&
               tree().size() + 1 == static_cast<std::size_t>(cuts_.num_parts);
    }

    /// Copies cuts that others share. Throws std::bad_alloc.
    void keep_shared();

    /// Sets whether look-ups may use the cuts. Without KEEP_CUTS, or a parameter that implies it,
    /// they are for the next partition only.
    void answer_look_ups(bool answers) { answers_look_ups_ = answers; }
    bool answers_look_ups() const { return answers_look_ups_ && shows_all(); }

    /// Cuts for the next partition, which may be spread over the ranks.
    const Cuts& cuts() const { return cuts_; }

    /// All cuts in preorder, where look-ups have them.
    std::span<const Cut> tree() const;

    const PartMap& map() const { return map_; }
    const Numbering& numbering() const { return numbering_; }

    /// Part of a position, one coordinate per dimension.
    Part part_of(const double* coordinates) const;

    /// Writes the parts that a closed box touches, ascending. Returns their number. `parts` has
    /// room for all.
    int parts_touching(const Box& box, Part* parts) const;

    /// Region of a part, open sides +-infinity.
    Box region_of(Part part) const;

    /// Node 1 ... parts - 1 of the tree; node 0 stands above the root. Its numbers are those before
    /// REMAP, as in Zoltan.
    TreeNode tree_node(int node) const;

  private:
    /// Index k is cut k; children below 0 are parts, the part p as ~p.
    struct Node {
        double plane = 0;
        std::int32_t axis = 0;
        std::array<std::int32_t, 2> child{};  ///< below the cut, above it
    };

    std::int32_t build(Part first_part, int num_parts);
    Part descend_spread(const double* position) const;
    bool is_above(std::size_t cut, const double* position) const;
    int collect(std::int32_t at, const Box& box, Part* parts, int count) const;

    Cuts cuts_;
    PartMap map_;
    Numbering numbering_;
    std::vector<Node> nodes_;
    std::vector<Cut> all_;         ///< where the cuts are spread over the ranks, or
    std::span<const Cut> shared_;  ///< where ranks share them
    std::int32_t root_ = 0;
    bool answers_look_ups_ = true;
};

}  // namespace rrcb::zoltan
