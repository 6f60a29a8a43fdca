#pragma once

#include "gather/extent.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>

#include <optional>
#include <span>
#include <vector>

namespace rrcb {

/// The distribution that the ranks hold, as a bisection.
struct KeptTree {
    Cuts cuts;
    std::vector<Part> parts;           ///< of each rank's points
    std::vector<double> part_weights;  ///< by count if all weights are 0
    double imbalance = 1;
};

/// True when no other axis of the box is much longer: less strict than a new cut has it, which
/// knows the extents by an estimate, or cuts might turn for ever.
bool is_long(const Box& box, int axis, int dimension);

/// Returns the cut between the points of two groups of ranks, in the middle of the gap if there is
/// one; nothing if no cut is allowed. It divides coincident points only if `may_divide`: those of
/// lower ranks are below.
std::optional<Cut> cut_between(const Extent& below, const Extent& above, int axis, int dimension,
                               bool plain_cuts, bool may_divide);

/// Reads the extents of the ranks, one each, as a bisection into the parts that the complete
/// `options` ask for, one per rank; nothing if they are no bisection. Not collective.
///
/// The cuts give each point the part of its rank, but for those in one place that a cut divides,
/// which has to be allowed. Rank r holds part r if that is possible; otherwise, if every rank has
/// points, parts go to the ranks in any order, as after a renumbering.
///
/// A cut counts if a new one might be there as well: across the axis of the cut in `estimate`, with
/// those above it, or a long axis of what it divides. So slabs of a cube are no bisection, and a
/// box whose sides are nearly the same is one either way. Limited cuts count across any axis, if
/// there are places for them between the ranks.
std::optional<KeptTree> read_kept_tree(std::span<const Extent> extents, const Cuts& estimate,
                                       const Options& options);

}  // namespace rrcb
