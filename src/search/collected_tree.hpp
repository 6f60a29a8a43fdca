#pragma once

#include "cuts/tree.hpp"
#include "passes/histogram.hpp"

#include <rrcb/passes.hpp>

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Collected points and their parts.
struct OpenPoints : Collected {
    std::vector<Part> parts{};  ///< of the arrived ones, no_part of the others
};

/// The points exactly at a cut, which no cut separates. They form one row over all ranks, in the
/// order of the ranks; the first of the row go below the cut.
struct Lot {
    double before = 0;   ///< weight on lower ranks
    double below = 0;    ///< weight of the row to come below; 0: all of it stays above
    double share = 0.5;  ///< share of the node's weight to come below

    /// Returns the side of a point of the row, the one that it makes less too heavy. `sum` is the
    /// weight of the points of its rank before it.
    bool is_above(double sum, double weight) const {
        return before + sum + (1 - share) * weight > below;
    }
};

/// The points of one rank in a lot, each with a weight above 0.
struct PointsInLot {
    double weight = 0;       ///< of all
    double first = 0;        ///< weight of the first of the row
    double last = 0;         ///< weight of the last
    double before_last = 0;  ///< weight of the others
};

/// The gap between the points on both sides of a cut; ranks join gaps by the maximum of each entry.
///
/// Along the axis number k of its order of positions, entry 2 k is minus the smallest coordinate
/// above the cut and entry 2 k + 1 the largest below. Only points exactly at the cut along the axes
/// before count; without any the entry is -infinity.
using Gap = std::array<double, std::size_t{2} * max_dimension>;

/// Collected points of one rank on their way down a tree of cuts.
///
/// A point waits at the first node whose cut may end on either side of it, until this cut is found.
/// Points in their part are settled. Without intervals a search holds the entries of
/// its nodes itself. Not collective.
class CollectedTree {
  public:
    /// Takes all points, without intervals. Borrows `points`. Throws std::bad_alloc.
    CollectedTree(PointPasses& points, OpenPoints&& all);

    /// Collects points as PointPasses::collect(). Borrows `points` and `cuts`, which may move but
    /// not turn. Throws what it throws.
    CollectedTree(PointPasses& points, const Cuts& cuts, std::span<const Bracket> intervals,
                  bool has_parts, OpenPoints&& memory);

    const Collected& points() const { return collected_; }
    OpenPoints take() { return std::move(collected_); }

    /// Returns the entries of all points.
    Entries all() const;

    /// Returns what waits at a node, with the arrived entries that may end on either side
    /// of its cut; the others go on.
    Entries admit(const Descent& at, const Entries& arrived);

    /// Lets entries wait at their node again.
    void put_back(std::size_t node, Entries&& entries) { waiting_[node] = std::move(entries); }

    /// Returns the total of the points below a node, without the entries taken from there.
    Total total_in(const Descent& at);

    /// Returns an interval in which the cut of a node may still end.
    const Bracket& interval(std::size_t node) const { return steps_[node].interval; }

    /// Takes other intervals of nodes, and collects the points there. Returns the entries of each
    /// node that are new to it.
    std::vector<Entries> collect_more(std::span<const Descent> nodes,
                                      std::span<const Bracket> intervals);

    /// Returns the entries below and above the cut of a node.
    std::pair<Entries, Entries> divide(Entries&& entries, const Cut& cut, const Lot& lot) const;

    /// Sets the part of entries, without totals.
    void settle(const Entries& entries, Part part);

    /// Returns the totals of a part on this rank, once no point waits.
    Total total_of(Part part) const;

    /// Writes the parts of the collected points where the others have theirs.
    void write_parts() { points_.settle(collected_, collected_.parts); }

    /// Returns the weights of the parts below a node by the cuts, with `entries` taken from it.
    std::vector<double> part_weights(const Descent& at, const Entries& entries);

    /// Returns the weight of entries.
    double weight_of(const Entries& entries) const;

    /// Appends the positions and weights of entries.
    void append(const Entries& entries, std::vector<double>& records) const;

    /// Settles the waiting entries by the cuts.
    void settle_rest();

    /// Returns the points exactly at a cut, in the order in which divide() takes them below.
    PointsInLot points_at(const Cut& cut, Entries entries) const;

    /// Returns the gap of this rank's points in a node around its cut.
    Gap gap_about(const Descent& at, const Entries& entries, const Cut& cut);

  private:
    /// A node as points meet it, in few bytes.
    struct Step {
        Bracket interval{};
        int axis = 0;
        int lower_parts = 0;
    };
    std::span<Entries> waiting_below(const Descent& at) {
        return std::span(waiting_).subspan(at.node, static_cast<std::size_t>(at.num_parts) - 1);
    }
    void settle(LocalIndex i, Part part);
    void send(const Descent& from, LocalIndex i);
    void add_steps(const Descent& at, std::span<const Bracket> intervals);
    std::vector<Entries> take_below(std::span<const Descent> nodes);
    void narrow(const Cut& cut, const Entries& entries, Gap& gap) const;
    void narrow_by_parts(const Descent& at, const Cut& cut, Gap& gap);

    PointPasses& points_;
    OpenPoints collected_;
    const Cuts* cuts_ = nullptr;
    std::vector<Step> steps_;       ///< at each node
    std::vector<Total> arrived_;    ///< totals of the collected points with parts
    std::vector<Entries> waiting_;  ///< at each node
    std::vector<Box> part_boxes_;   ///< of settled points; empty until a gap needs them
};

}  // namespace rrcb
