#pragma once

#include "cuts/point_block.hpp"
#include "cuts/tree.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

/// Number in place of a part where a node on the way to it is not known.
constexpr Part unknown_below(std::size_t node) {
    return ~static_cast<Part>(node);
}
constexpr bool is_unknown(Part part) {
    return part < 0;
}
constexpr std::size_t unknown_node(Part part) {
    return static_cast<std::size_t>(~part);
}

/// Look-up of the parts of a block by cuts of which only some are known.
///
/// Of these it holds the ones that divide a box of the points. Its exits are parts, and nodes that
/// are not known; a bin is the number of an exit.
class KnownTree {
  public:
    /// `cuts` outlive it. In time and memory as there are known cuts.
    KnownTree(const Cuts& cuts, const Box& box) : cuts_(cuts) { link(root_of(cuts), box, 0); }

    std::size_t num_bins() const { return exits_.size(); }

    void find(const Columns& columns, LocalIndex length, std::int32_t* bins);

    /// Turns bins into parts, see unknown_below().
    void write_parts(std::span<Part> bins) const;
    const std::vector<Part>& parts_of_bins() const { return exits_; }

  private:
    std::int32_t link(Descent at, const Box& box, int depth);
    std::int32_t add(double plane, std::int32_t axis, const Cut* cut);
    std::int32_t exit_of(const Vector& position) const;

    const Cuts& cuts_;
    // Of each node of this tree, the first being its root. An exit is its own child on both sides.
    std::vector<double> planes_;
    std::vector<double> ties_;  ///< the planes on which points are told apart by position, or NaN
    std::vector<std::int32_t> axes_;
    std::vector<std::int32_t> children_;  ///< two for each, below and above
    std::vector<const Cut*> nodes_;       ///< null for exits
    std::vector<std::int32_t> bins_;      ///< of exits
    std::vector<Part> exits_;             ///< of each bin
    int depth_ = 0;
    bool is_plain_ = true;  ///< every cut is a plane, none breaks ties by position
    TiedPoints tied_{};
};

}  // namespace rrcb
