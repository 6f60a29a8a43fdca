#pragma once

#include "collective/participant.hpp"

#include <rrcb/paper.hpp>

namespace rrcb {

/// Divides as the public function, over a duplicated communicator. An earlier failure of a rank is
/// thrown on all ranks; its options are not used.
Balance balance_as_in_paper(const Points& points, const PaperOptions& options, Participant& self);

}  // namespace rrcb
