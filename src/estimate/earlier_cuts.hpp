#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>

namespace rrcb {

/// Returns the cuts of an earlier call, fitted to complete options: they are planes if the options
/// ask for it, and parts of size 0 get nothing. They do not divide coincident points, because a
/// look-up keeps these together.
Cuts fitted(Cuts previous, const Options& options);

}  // namespace rrcb
