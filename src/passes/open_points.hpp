#pragma once

#include "cuts/tree.hpp"
#include "passes/histogram.hpp"

#include <rrcb/detail/passes.hpp>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace rrcb {

/// Memory of open points, which the next call reuses.
struct OpenMemory {
    Collected points{};
    std::vector<Part> parts{};  ///< part of each point; no_part while it waits
};

/// Coincident points exactly at a cut, which divides them. They form one sequence over all ranks,
/// in the order of ranks; the first of the sequence go below the cut.
struct Lot {
    double before = 0;   ///< weight of the lot on lower ranks
    double below = 0;    ///< weight of the lot that should go below; if 0, all of it stays above
    double share = 0.5;  ///< share of the node's weight that should be below the cut

    /// Returns whether a point of the lot goes above: it goes to the side that it makes less too
    /// heavy. `sum` is the weight of the points of the same rank before it.
    bool is_above(double sum, double weight) const {
        return before + sum + (1 - share) * weight > below;
    }
};

/// The points of one rank in a lot. Only points with a weight above 0 count.
struct PointsInLot {
    double weight = 0;       ///< sum of all weights
    double first = 0;        ///< weight of the first point
    double last = 0;         ///< weight of the last point
    double before_last = 0;  ///< weight of all points except the last
};

/// The gap between the points on both sides of a cut. Ranks join gaps by the maximum of each entry.
///
/// For axis number k of the cut's order of positions, entry 2 k is the negative of the smallest
/// coordinate above the cut, and entry 2 k + 1 is the largest coordinate below. Only points that
/// are exactly at the cut along all earlier axes count; if there are none, the entry is -infinity.
using Gap = std::array<double, std::size_t{2} * max_dimension>;

/// A node whose cut may end in another interval than the one searched before.
struct WiderNode {
    Descent at;
    Bracket interval;
};

/// The open points of one rank on their way down a tree of cuts, with the functions that a search
/// needs.
///
/// A point waits at the first node whose cut may end on either side of it, until cut() moves it on.
/// All other points are settled. The candidates of a node are the points that wait there, or those
/// chosen among them. Functions return numbers; only take() returns positions. No function is
/// collective. Each may throw std::bad_alloc, and Error if the passes fail.
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

    /// Returns the total of the points in the parts of a node: those settled there, and those still
    /// on their way below it. Returns 0 in a tree without cuts.
    virtual Total total_in(const Descent& at) const = 0;

    /// Adds the candidates of a node to a histogram across an axis.
    virtual void count(const Descent& at, int axis, const Bins& bins, const HistogramLayout& layout,
                       std::span<double> histogram) const = 0;

    /// Adds the candidates of a node to the sums of a histogram, without the extents.
    virtual void count_sums(const Descent& at, int axis, const Bins& bins,
                            const HistogramLayout& layout, std::span<double> sums) const = 0;

    /// Keeps only the candidates of a node with lower <= x < upper.
    virtual void choose(const Descent& at, int axis, const Bracket& interval) = 0;

    /// Appends the position and weight of each candidate of a node.
    virtual void take(const Descent& at, std::vector<double>& records) const = 0;

    /// Returns the points at a node that are exactly at a cut, in the order in which cut() puts
    /// them below.
    virtual PointsInLot lot(const Descent& at, const Cut& cut) const = 0;

    /// Returns the gap around the cut of a node, as far as this rank's points determine it.
    virtual Gap gap(const Descent& at, const Cut& cut) = 0;

    /// Moves the points at a node on, to both sides of its cut.
    virtual void cut(const Descent& at, const Cut& cut, const Lot& lot) = 0;

    /// Gives nodes other intervals; no node may be above or below another one. The points in the
    /// new intervals become candidates as well. Reads all points once.
    virtual void widen(std::span<const WiderNode> nodes) = 0;

    /// Gives all points their part; points that still wait get it from the cuts. Returns the weight
    /// of this rank's points in each part. Must be the last call.
    virtual std::vector<double> settle() = 0;
};

/// Opens points by PointPasses::open() if the passes have it; otherwise copies them by the other
/// passes.
std::unique_ptr<OpenPoints> open_points(PointPasses& points, const Cuts& cuts,
                                        std::span<const Bracket> intervals, bool has_parts,
                                        OpenMemory& memory);

}  // namespace rrcb
