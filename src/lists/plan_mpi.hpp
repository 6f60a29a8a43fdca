#pragma once

#include "collective/participant.hpp"

#include <rrcb/transfer.hpp>

#include <span>

namespace rrcb {

/// As the public function, over a communicator that is a duplicate already. A failure from before
/// the call is thrown on all ranks as well.
Plan plan(std::span<const Part> parts, int num_parts, Participant& self);

/// As transfer(), for columns without their types.
void move(const Plan& plan, std::span<const detail::ByteColumn> columns,
          const TransferLimits& limits, TransferReport* report, Participant& self);

}  // namespace rrcb
