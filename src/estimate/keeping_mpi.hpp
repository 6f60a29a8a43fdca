#pragma once

#include "estimate/decision_mpi.hpp"

#include <rrcb/passes.hpp>

#include <span>

// When points stay in their parts.

namespace rrcb {

/// Returns true if points may be kept in the parts that the ranks hold, one each: rank 0 then reads
/// the extents and weights of the points of all ranks. Only up to some number of ranks, and without
/// limits of cuts. `options` are complete.
bool reads_kept_tree(const Options& options, int num_ranks);

/// Returns true if no better parts are searched for.
bool keeps_at_once(double kept, const Options& options);

/// Returns true if exact cuts, with parts of the weights `found`, are not worth moving points out
/// of parts of the weights `kept`: these are as even, and at every cut as near to its share, but
/// for round-off, and for a point if the cut divides coincident ones, of which `heaviest` is a
/// bound.
bool are_as_exact(std::span<const double> kept, std::span<const double> found, const Cuts& cuts,
                  double heaviest, const Options& options);

/// Returns true if parts of the imbalance `offered` are worth moving points out of parts of the
/// imbalance `kept`.
///
/// Points at rest are therefore kept after a few calls. Each call that moves points
/// reduces the imbalance: by a twentieth of (tolerance - 1), or from above the tolerance to within
/// it.
bool is_worth_moving(double kept, double offered, const Options& options);

/// Returns true if new parts are worth moving points out of the parts of earlier cuts, which are
/// not within the tolerance: if their imbalance is worth it, or if they leave fewer parts of equal
/// size empty without a loss.
bool is_worth_moving(const Report& kept, const Report& offered, const Options& options);

/// Returns true if the parts made are not worth moving points out of the ranks' present parts.
bool keeps_after_all(const Decision& decision, const Options& options, const Balance& made);

/// Replaces the cuts by those across other axes, if far fewer points are near them than near the
/// cuts between the ranks, `held`. The parts that the ranks hold are then not kept. Points are
/// counted for this, because an estimate depends on which ranks hold the points, and might turn the
/// cuts in every call. Returns whether the cuts turn. Collective: a reduction.
bool turns(Decision& decision, const Cuts& held, PointPasses& points, Participant& self);

}  // namespace rrcb
