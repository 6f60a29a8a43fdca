#pragma once

#include "zoltan/handle/parameters.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/remap.hpp>

#include <string>
#include <vector>

namespace rrcb::zoltan {

/// Whether RCB_OUTPUT_LEVEL or FINAL_OUTPUT is above 0, or DEBUG_LEVEL at 10, from which Zoltan
/// tells of REMAP.
bool asks_for_report_line(const Parameters& parameters);

/// The line of RCB_OUTPUT_LEVEL: size, imbalance, rounds and what the new part numbers saved.
std::string report_line(const Report& report, int num_parts, const Remap& remap);

/// What kept the parts from the balance asked for, a sentence each.
std::vector<std::string> balance_warnings(const Report& report, const Parameters& parameters);

}  // namespace rrcb::zoltan
