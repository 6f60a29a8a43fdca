#pragma once

#include "collective/participant.hpp"

#include <rrcb/groups.hpp>

namespace rrcb {

/// As the functions of groups.hpp; an earlier failure on one rank is thrown on all. Collective.
Groups groups(const Points& points, std::span<const std::uint64_t> keys, GroupPlace place,
              Participant& self);
void move(const Groups& groups, std::span<const detail::ByteColumn> columns,
          const TransferLimits& limits, TransferReport* report, Participant& self);
std::vector<double> sums(const Groups& groups, std::span<const double> values,
                         std::size_t components, Participant& self);

}  // namespace rrcb
