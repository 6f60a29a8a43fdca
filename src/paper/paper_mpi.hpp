#pragma once

#include "collective/participant.hpp"

#include <rrcb/paper.hpp>

namespace rrcb {

/// Divides as the public function does, over the duplicated communicator. If a rank has failed
/// before, throws its error on all ranks.
Balance balance_as_in_paper(const Points& points, const PaperOptions& options, Participant& self);

}  // namespace rrcb
