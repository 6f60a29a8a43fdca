#pragma once

#include "zoltan/call/layout_mpi.hpp"
#include "zoltan/handle/state.hpp"

#include <rrcb/options.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace rrcb::zoltan {

/// Returns whether Zoltan's RCB has to answer a partitioning call with these parameters.
///
/// RRCB balances one weight, and cuts across the coordinate axes, between two objects or at an
/// object. All ranks return the same if none of the compared parameters differs between them.
bool forwards(const Parameters& parameters);

/// Prints on rank 0, once in a program, why Zoltan's RCB answers a call of RRCB. Prints nothing if
/// DEBUG_LEVEL is 0.
void print_forwarding(const State& state, const char* function) noexcept;

/// Throws ZoltanError for parameters that RRCB does not support. `one_part_per_rank` is for
/// Zoltan_LB_Balance.
void check_parameters(const State& state, bool one_part_per_rank);

/// Returns the options of the balancer for one call. `previous` is the last partition, if look-ups
/// have all of its cuts, or null.
///
/// RCB_LOCK_DIRECTIONS takes the axes of those cuts; otherwise RCB_SET_DIRECTIONS determines the
/// order of axes.
Options make_options(const Parameters& parameters, const Layout& layout, int dimension,
                     const LastPartition* previous);

/// Returns the options of the paper's method that RRCB_DOMAIN asks for.
PaperOptions make_paper_options(const Parameters& parameters, const Layout& layout);

/// Returns whether the search starts from the cuts of the last call (RCB_REUSE). That needs a
/// refinement, because otherwise those cuts would be kept although they miss the requested balance.
bool starts_from_previous(const Parameters& parameters);

/// Returns whether look-ups may use the cuts.
bool keeps_cuts(const Parameters& parameters);

/// Returns whether a parameter affects which axes are cut. If it changes, older cuts may cross
/// other axes.
bool chooses_axes(std::string_view name);

/// Returns warnings about settings that have no effect, one sentence for each, in Zoltan's words if
/// Zoltan has such a warning.
std::vector<std::string> parameter_warnings(const Parameters& parameters);

}  // namespace rrcb::zoltan
