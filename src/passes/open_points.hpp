#pragma once

#include "cuts/tree.hpp"
#include "passes/histogram.hpp"

#include <rrcb/passes.hpp>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace rrcb {

/// Memory of open points, which the next call reuses.
struct OpenMemory {
    Collected points{};
    std::vector<Part> parts{};  ///< of each point, no_part of those that wait
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

/// A node whose cut may end in another interval than before.
struct WiderNode {
    Descent at;
    Bracket interval;
};

/// Open points of one rank on their way down a tree of cuts, as a search asks for them.
///
/// A point waits at the first node whose cut may end on either side of it, until cut() sends it on.
/// Other points are settled. The candidates of a node are the points waiting there, or those chosen
/// among them. Answers are numbers; only take() returns positions. Not collective. Each function
/// may throw std::bad_alloc, and Error if the passes fail.
class OpenPoints {
  public:
    OpenPoints() = default;
    OpenPoints(const OpenPoints&) = delete;
    OpenPoints& operator=(const OpenPoints&) = delete;
    virtual ~OpenPoints() = default;

    /// Returns true if no point waits at a node.
    virtual bool is_empty(const Descent& at) const = 0;

    /// Returns the weight of the points that wait at a node, or at a part of a tree without cuts.
    virtual double weight_at(const Descent& at) const = 0;

    /// Returns the total of the points in the parts of a node, settled or on their way below; 0 in
    /// a tree without cuts.
    virtual Total total_in(const Descent& at) const = 0;

    /// Adds the candidates of a node to a histogram across an axis.
    virtual void count(const Descent& at, int axis, const Bins& bins, const HistogramLayout& layout,
                       std::span<double> histogram) const = 0;

    /// Adds the candidates of a node to the sums of a histogram, without the extents.
    virtual void count_sums(const Descent& at, int axis, const Bins& bins,
                            const HistogramLayout& layout, std::span<double> sums) const = 0;

    /// Chooses the candidates with lower <= x < upper among those of a node.
    virtual void choose(const Descent& at, int axis, const Bracket& interval) = 0;

    /// Appends position and weight of each candidate of a node.
    virtual void take(const Descent& at, std::vector<double>& records) const = 0;

    /// Returns the points at a node that are exactly at a cut, in the order in which cut() takes
    /// them below.
    virtual PointsInLot lot(const Descent& at, const Cut& cut) const = 0;

    /// Returns the gap of this rank's points in a node around its cut.
    virtual Gap gap(const Descent& at, const Cut& cut) = 0;

    /// Sends the points at a node on, to both sides of its cut.
    virtual void cut(const Descent& at, const Cut& cut, const Lot& lot) = 0;

    /// Replaces the intervals of nodes without a common part. The points there become candidates as
    /// well. Reads all points once.
    virtual void widen(std::span<const WiderNode> nodes) = 0;

    /// Gives all points their part, those that still wait by the cuts. Returns the weights of this
    /// rank's points in each part. Called last.
    virtual std::vector<double> settle() = 0;
};

/// Opens points by PointPasses::open(), or keeps copies of them by the other passes.
std::unique_ptr<OpenPoints> open_points(PointPasses& points, const Cuts& cuts,
                                        std::span<const Bracket> intervals, bool has_parts,
                                        OpenMemory& memory);

}  // namespace rrcb
