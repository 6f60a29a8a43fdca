#pragma once

#include "collective/participant.hpp"

#include <rrcb/paper.hpp>

namespace rrcb {

/// Divides as the public function does, over a communicator that is a duplicate already. A failure
/// from before the call is thrown on all ranks; the options of that rank are not used.
Balance balance_as_in_paper(const Points& points, const PaperOptions& options, Participant& self);

}  // namespace rrcb
