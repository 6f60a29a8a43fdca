#pragma once

#include <cstdint>

namespace rrcb {

namespace detail {
struct StampAccess;
}  // namespace detail

/// Identifies the call that made cuts or a plan. By it other calls refuse another communicator,
/// points that were not transferred, and ghosts that were found before a transfer.
class Stamp {
    friend struct detail::StampAccess;
    std::uint64_t ranks_ = 0;
    std::uint64_t points_ = 0;
};

/// Returns cuts or a plan without their stamp, for use on other ranks or with other points: calls
/// with them do not check either. Not collective.
///
///     const std::vector<rrcb::Part> parts = rrcb::assign(rrcb::unstamped(cuts), points,
///     other_comm);
///
/// @param stamped Cuts, a Plan or a GhostPlan
template <class Stamped>
[[nodiscard]] Stamped unstamped(Stamped stamped) {
    stamped.stamp = Stamp();
    return stamped;
}

}  // namespace rrcb
