#pragma once

#include "gather/extent.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>

#include <optional>
#include <span>
#include <vector>

namespace rrcb {

/// The current distribution over the ranks, as a bisection.
struct KeptTree {
    Cuts cuts;
    std::vector<Part> parts;  ///< of each rank's points
    std::vector<double> part_weights;
    double imbalance = 1;
};

/// Returns true if rank r holds part r for every rank: then nothing moves.
bool is_in_order(const KeptTree& kept);

/// Returns true if no other axis of the box is much longer. This is less strict than for a new cut,
/// whose extents are estimated; otherwise cuts might turn in every call.
bool is_long(const Box& box, int axis, int dimension);

/// Returns the cut between the points of two groups of ranks, in the middle of the gap if there is
/// one; nullopt if no cut is allowed. It divides coincident points only if `may_divide`: those of
/// lower ranks are below.
std::optional<Cut> cut_between(const Extent& below, const Extent& above, int axis, int dimension,
                               bool plain_cuts, bool may_divide);

/// Reads the extents of the ranks, one each, as a bisection into the parts of the complete
/// `options`, one per rank; nullopt if they are no bisection. Not collective.
///
/// The cuts give each point the part of its rank, except coincident points that a cut divides, if
/// the options allow it. Rank r holds part r if that is possible. Otherwise the ranks hold the
/// parts in another order, as after a renumbering.
///
/// With AxisOrder::longest() a cut must be across an axis that a new cut might have:
/// - that of the same cut in `estimate`, if all cuts above it are across those of `estimate` too,
/// - or a long axis of the points that it divides. Slabs of a cube are therefore no bisection.
///
/// Limited cuts, and those of fewest_ghosts(), may be across any allowed axis. For the latter the
/// caller calls are_axes_good().
std::optional<KeptTree> read_kept_tree(std::span<const Extent> extents, const Cuts& estimate,
                                       const Options& options);

}  // namespace rrcb
