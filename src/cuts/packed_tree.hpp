#pragma once

#include "cuts/tree.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace rrcb {

inline constexpr LocalIndex block_length = 512;

/// Position of a plane that has all points below it.
inline constexpr double nowhere = std::numeric_limits<double>::infinity();

/// Coordinates of the points of a block: one array per axis.
using Columns = std::array<std::array<double, block_length>, max_dimension>;

/// The cuts of a tree in one array, for fast look-ups.
///
/// The two nodes below a cut are adjacent in the array. An end of the tree is its own child, so
/// that all points of a block can take the same number of steps.
class PackedTree {
  public:
    /// Returns the entry for an end of the tree.
    using EntryOf = std::function<Part(Part end)>;

    PackedTree() = default;

    /// Packs all cuts. `cuts.tree` must outlive this object and must not be moved.
    explicit PackedTree(const Cuts& cuts, const EntryOf& entry_of = {}) { pack(cuts, entry_of); }

    /// Reserves memory for the cuts between this many parts, which may be 0.
    void reserve(std::size_t num_parts);

    /// Packs as the constructor does, in the reserved memory. May be called once.
    void pack(const Cuts& cuts, const EntryOf& entry_of);

    /// Returns the entries of the ends in ascending order of ends. Without an EntryOf the entry of
    /// end k is k.
    const std::vector<Part>& entries() const { return entries_; }

    /// Finds the number of the end of each point of a block.
    void find(const Columns& columns, LocalIndex length, std::int32_t* ends) const;

    /// Returns the number of the end of a position, one coordinate per dimension.
    std::int32_t end_of(const double* position) const {
        std::int32_t node = 0;
        for (std::int32_t lower = 0; (lower = lower_of(node)) != node;)
            // Computes the child without a branch, which would be mispredicted for positions in any
            // order.
            node = lower + (is_above(node, position) ? 1 : 0);
        return nodes_[node].item;
    }

    std::int32_t num_nodes() const { return static_cast<std::int32_t>(nodes_.size()); }
    bool is_end(std::int32_t node) const { return lower_of(node) == node; }
    Part entry_at(std::int32_t node) const { return entries_[nodes_[node].item]; }

    /// Returns the node below a cut; the node above it is the next one.
    std::int32_t lower_of(std::int32_t node) const { return nodes_[node].lower; }

    int axis_of(std::int32_t node) const { return nodes_[node].axis; }
    double plane_of(std::int32_t node) const { return nodes_[node].plane; }

    /// Calls visit(entry) for the ends at or below a node that touch a box; see parts_touching().
    template <class Visit>
    void visit_touching(const Box& box, Visit&& visit, std::int32_t node = 0) const {
        const std::int32_t lower = lower_of(node);
        if (lower == node) return visit(entry_at(node));
        if (!is_above(node, box.lower.data()) ||
            holds_divided_points(box, cuts_[nodes_[node].item], dimension_))
            visit_touching(box, visit, lower);
        if (is_above(node, box.upper.data())) visit_touching(box, visit, lower + 1);
    }

    static constexpr int top_levels = 3;
    static constexpr int num_top_nodes = 7;

    /// The cuts of the first three levels. The children of cut k are cuts 2 k + 1 (below) and 2 k +
    /// 2 (above).
    struct Top {
        std::array<double, num_top_nodes> planes;
        std::array<std::int32_t, num_top_nodes> axes;
        /// Results of three comparisons: numbers of ends if the tree has no more levels, otherwise
        /// numbers of nodes. They are doubles, because vector instructions select these as fast as
        /// they compare.
        std::array<double, num_top_nodes + 1> exits;
    };

    /// A cut, or an end.
    struct Node {
        double plane = nowhere;  ///< nowhere at ends
        std::int32_t axis = 0;
        std::int32_t lower = 0;  ///< the node below the cut; at an end, the end itself
        std::int32_t item = 0;   ///< index of the cut, or number of the end
    };

  private:
    void add(const Descent& at, const EntryOf& entry_of, std::int32_t node, int depth);
    void find_top();

    bool is_above(std::int32_t node, const double* position) const {
        const double x = position[axis_of(node)];
        if (x != plane_of(node)) [[likely]]
            return x > plane_of(node);
        return is_above_exactly(node, position);
    }
    bool is_above_exactly(std::int32_t node, const double* position) const;

    std::span<const Cut> cuts_;
    int dimension_ = 0;
    std::vector<Node> nodes_;
    std::vector<Part> entries_;  ///< entries of the ends
    int depth_ = 0;
    bool is_plain_ = true;  ///< whether every cut is a plane that does not break ties by other
                            ///< coordinates
    Top top_{};
};

}  // namespace rrcb
