#pragma once

#include "collective/participant.hpp"

#include <rrcb/ghosts.hpp>

#include <span>

namespace rrcb {

/// As the public functions, over a communicator that is a duplicate already. A failure from before
/// a call is thrown on all ranks as well. Collective.
GhostPlan ghosts(const Cuts& cuts, const Points& points, const GhostOptions& options,
                 Participant& self);
void move(const GhostPlan& plan, std::span<const detail::ByteColumn> columns,
          const TransferLimits& limits, TransferReport* report, Participant& self);
void move_back(const GhostPlan& plan, std::span<const detail::ByteColumn> of_ghosts,
               std::span<const detail::ByteColumn> of_points, const TransferLimits& limits,
               TransferReport* report, Participant& self);

}  // namespace rrcb
