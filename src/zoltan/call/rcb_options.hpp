#pragma once

#include "zoltan/call/layout_mpi.hpp"
#include "zoltan/handle/state.hpp"

#include <rrcb/options.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace rrcb::zoltan {

/// Returns whether Zoltan's RCB is to answer a partitioning call with these parameters.
///
/// RRCB balances one weight and cuts across the axes of the coordinates, between two objects or at
/// one. All ranks decide alike if none of the compared parameters differs between them.
bool forwards(const Parameters& parameters);

/// Prints once in a program, on rank 0, why Zoltan's RCB answers a call of RRCB. Prints nothing
/// at DEBUG_LEVEL 0.
void print_forwarding(const State& state, const char* function) noexcept;

/// Throws ZoltanError for parameters that RRCB does not serve. Zoltan_LB_Balance makes one part per
/// rank.
void check_parameters(const State& state, bool one_part_per_rank);

/// Returns the options of the balancer for one call. `previous`: the last partition, of which
/// look-ups have all cuts, or null.
///
/// RCB_LOCK_DIRECTIONS takes their axes; otherwise RCB_SET_DIRECTIONS names the order of axes.
Options make_options(const Parameters& parameters, const Layout& layout, int dimension,
                     const LastPartition* previous);

/// Returns the options of the paper's method asked for by RRCB_DOMAIN.
PaperOptions make_paper_options(const Parameters& parameters, const Layout& layout);

/// Returns whether the search starts from the cuts of the last call (RCB_REUSE). This needs a
/// refinement, to reach the balance asked for from them.
bool starts_from_previous(const Parameters& parameters);

/// Returns whether look-ups may use the cuts.
bool keeps_cuts(const Parameters& parameters);

/// Returns whether the parameter decides which axes are cut. After a change older cuts may cross
/// other axes.
bool chooses_axes(std::string_view name);

/// Returns warnings of settings that are not kept, a sentence each, in Zoltan's words if it has
/// some.
std::vector<std::string> parameter_warnings(const Parameters& parameters);

}  // namespace rrcb::zoltan
