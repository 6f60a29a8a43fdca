#pragma once

#include "gather/decision_mpi.hpp"
#include "gather/spread_places_mpi.hpp"
#include "search/refinement_mpi.hpp"

#include <rrcb/balance.hpp>

#include <optional>

namespace rrcb {

/// True when many ranks make the parts below regions, see Tuning::central_parts; by complete
/// options.
bool is_wide(const Options& options, int num_ranks);

/// True when a call from these cuts keeps or replaces them without any rank that looks at all of
/// them. `options` as given.
bool reuses_spread(const Cuts& previous, const Options& options, int num_ranks);

/// Regions that rank 0 makes at most. With more it would receive more than a rank that owns nodes.
inline constexpr int most_regions = 64;

/// Options by which the regions are made in place of parts: as many as the largest power of two up
/// to central_parts and most_regions, and to a tolerance that leaves the levels below theirs. For
/// exact cuts there is one region: rank 0 would gather a few points about each cut, and a number
/// from each rank. Sizes are normalized, or empty.
Options region_options(const Options& options);

/// Cells that a merging leaves for the regions at most, whatever the mesh: so few that no rank,
/// which takes in those of seven others at once, receives more than 64 kB.
inline constexpr std::size_t most_cells_of_regions = 112;

/// Weight of all points, or their number if they are balanced by that.
double weight_of(const Report& report);

/// Tells how even the parts of a call with these complete options are, where there are points, and
/// could be at best.
void report_parts(double imbalance, double heaviest, double weight, const Options& options,
                  Report& report);

/// What the ranks hold, of points of which `report` tells; see SpreadPlaces::read(). Nothing
/// without places, or points. Collective.
std::optional<SpreadParts> read_held(std::optional<SpreadPlaces>& places, const Report& report,
                                     RegionRefinement& refinement, Participant& self);

/// Leaves the points in the parts that the ranks hold, by the complete options of a call; `result`
/// tells of all points. Collective.
void stay_spread(const Options& options, double heaviest, SpreadParts&& held, Balance& result,
                 Participant& self);

/// Makes the parts below the regions that are the parts of `result`.
///
/// Collective. `options` are those of the call, complete. `verdict` tells of all points; `box`
/// holds this rank's at least, and `binned` has them.
void refine_regions(const Options& options, const Verdict& verdict, const Box& box,
                    const BinnedPoints& binned, RegionRefinement& refinement, Balance& result,
                    Participant& self);

/// Gives each rank the cuts that Options::cuts asks for after many ranks made the parts; with all
/// cuts also the weights of all parts.
///
/// Collective: two reductions for all cuts. For own ones nothing, unless points in one place are
/// divided: then as assign(), as look-ups of them go to the upper side of a cut.
void hold_cuts(const Points& points, const Options& options, Balance& result, Participant& self);

}  // namespace rrcb
