#pragma once

#include "collective/participant.hpp"

#include <rrcb/passes.hpp>

#include <cstdint>
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

/// Returns true if parts from earlier cuts are so uneven, although `least` is possible, that the
/// axes of these cuts, which are kept, may be why.
bool may_be_poor(double imbalance, double least, const Options& options);

/// Returns true if NearCuts::share has grown so much that other axes may save ghosts.
bool may_save_ghosts(const Options& options, const NearCuts& chosen, double share_now);

/// Returns NearCuts::share for later calls, if the axes are kept; `chosen` is that of the call
/// before, 0 after a comparison. It falls by a twentieth if cuts were moved: other axes may have
/// become better, so calls moving cuts compare new ones now and then.
double reference(double chosen, double share_now, bool are_moved);

/// Compares the points near two sets of cuts, by samples of the `count` points of each rank.
/// Returns true if the new cuts are worth moving points. Collective.
bool saves_ghosts(const Cuts& reused, const Cuts& anew, const PointSample& sample, LocalIndex count,
                  const Participant& self);

/// Returns the distance from a cut within which has_far_fewer_near() counts: some spacings of
/// points that fill their box. It is the same whichever ranks hold the points.
double wide_reach(const Box& box, std::int64_t num_points);

/// Returns true if far fewer points are near the cuts `turned` than near `held`. By counts, because
/// an estimate depends on which ranks hold the points, and might turn the cuts in every call.
/// Collective: a reduction.
bool has_far_fewer_near(const Cuts& turned, const Cuts& held, double reach, PointPasses& points,
                        Participant& self);

/// Returns the better balance: that from scratch if its balance is worth moving points, or if
/// there is a sample and much fewer points of it are near its cuts; otherwise the points get back
/// their `parts` by the cuts reused. Collective.
Balance better(Balance&& reused, std::span<const Part> parts, Balance&& anew, PointPasses& points,
               const Options& options, const PointSample* sample, Participant& self);

}  // namespace rrcb
