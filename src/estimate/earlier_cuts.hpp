#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>

namespace rrcb {

/// Returns the cuts of an earlier call fitted to complete options: planes if asked for, and nothing
/// in parts of size 0. They divide no coincident points, which the look-up keeps together.
Cuts fitted(Cuts previous, const Options& options);

}  // namespace rrcb
