#pragma once

#include "layout_mpi.hpp"
#include "parameters.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>

#include <string>
#include <vector>

namespace rrcb::zoltan {

/// What a call asks of the balancer. `previous` are the cuts of the last call, or null.
///
/// RCB_LOCK_DIRECTIONS takes their axes, otherwise RCB_SET_DIRECTIONS names the order of axes.
Options make_options(const Parameters& parameters, const Layout& layout, int dimension,
                     const Cuts* previous);

/// Whether the search is to start from the cuts of the last call (RCB_REUSE): only where it goes
/// on from there to the balance asked for.
bool starts_from_previous(const Parameters& parameters);

/// Whether the call after this one may want its cuts.
bool keeps_cuts(const Parameters& parameters);

/// What is asked for and not kept, one sentence each, in Zoltan's words where it has some.
std::vector<std::string> shortcomings(const Parameters& parameters);

}  // namespace rrcb::zoltan
