#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/detail/passes.hpp>
#include <rrcb/options.hpp>

#include <optional>
#include <span>
#include <vector>

namespace rrcb {

/// Adds the points of another extent: updates the count, weight, first and last positions of a
/// summary.
void join(PointSummary& extent, const PointSummary& other, int dimension);

/// Appends an extent as 2 + 2 dimension^2 doubles.
void append_extent(const PointSummary& extent, int dimension, std::vector<double>& doubles);

/// Returns the extents in the order in which they were appended.
std::vector<PointSummary> read_extents(std::span<const double> doubles, int dimension);

/// The present distribution of the points over the ranks, as a bisection.
struct KeptTree {
    Cuts cuts;
    std::vector<Part> parts;  ///< part of each rank's points
    std::vector<double> part_weights;
    double imbalance = 1;
};

/// Returns true if every rank r holds part r, so that nothing moves. `parts` are ends of the tree.
bool is_in_order(const Cuts& cuts, std::span<const Part> parts);

/// Reads the extents of the ranks, one each, as a bisection into the parts of the complete
/// `options`, one part per rank. Returns nullopt if they are not a bisection. Not collective.
///
/// The cuts give each point the part of its rank, except coincident points that a cut divides, if
/// the options allow it. Below each cut the ranks are in the order of their numbers if possible.
/// Otherwise they hold the parts in another order, for example after a renumbering.
///
/// With AxisOrder::longest() a cut must be across an axis that a new cut might have:
/// - the axis of the same cut in `estimate`, if all cuts above it are also across the axes of
///   `estimate`,
/// - or a long axis of the points that it divides. Slabs of a cube are therefore not a bisection.
///
/// With fewest_ghosts() cuts may be across any allowed axis, and the caller checks are_axes_good().
std::optional<KeptTree> read_kept_tree(std::span<const PointSummary> extents, const Cuts& estimate,
                                       const Options& options);

}  // namespace rrcb
