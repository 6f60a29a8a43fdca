#pragma once

#include "estimate/decision_mpi.hpp"

#include <rrcb/detail/passes.hpp>

#include <span>

// Rules that decide when points remain in their parts.

namespace rrcb {

/// Returns true if the parts that the ranks hold now, one each, may be kept. Rank 0 then reads the
/// extent and weight of every rank's points. False for many ranks, and if cuts are limited. The
/// options must be complete.
bool reads_kept_tree(const Options& options, int num_ranks);

/// Returns true if parts of the imbalance `kept` are good enough that no better ones are searched
/// for.
bool keeps_at_once(double kept, const Options& options);

/// Returns true if exact cuts are not worth moving points. They would change the weights of the
/// parts from `kept` to `found`. They are not worth it if the kept parts are as even, and each of
/// their cuts is as near to its target. Round-off is allowed for, and so is a point at a cut that
/// divides coincident points; `heaviest` bounds the weight of a point.
bool are_as_exact(std::span<const double> kept, std::span<const double> found, const Cuts& cuts,
                  double heaviest, const Options& options);

/// Returns true if reducing the imbalance from `kept` to `offered` is worth moving points.
///
/// Each call that moves points reduces the imbalance: by a twentieth of (tolerance - 1), or from
/// above the tolerance to within it. Resting points are therefore kept after a few calls.
bool is_worth_moving(double kept, double offered, const Options& options);

/// Returns true if new parts are worth moving points, when the parts of earlier cuts are not within
/// the tolerance. They are worth it because of their imbalance, or if they leave fewer parts of
/// equal size empty without a larger imbalance.
bool is_worth_moving(const Report& kept, const Report& offered, const Options& options);

/// Returns true if the parts that were made are not worth moving points from the ranks' present
/// parts.
bool keeps_after_all(const Decision& decision, const Options& options, const Balance& made);

/// Replaces the cuts by `decision.turned`, across other axes, if far fewer points are near those
/// than near `held`, the cuts between the ranks. The parts that the ranks hold are then not kept.
/// Counts points instead of using the estimate, which depends on which ranks hold the points and
/// might turn the cuts in every call. Returns whether the cuts turn. Collective: one reduction.
bool turns(Decision& decision, const Cuts& held, PointPasses& points, Participant& self);

}  // namespace rrcb
