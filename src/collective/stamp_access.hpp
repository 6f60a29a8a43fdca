#pragma once

#include <rrcb/stamp.hpp>

namespace rrcb::detail {

/// Reads and writes stamps.
struct StampAccess {
    /// The random number that identifies the ranks; 0: none, as of a call on one rank.
    static std::uint64_t& ranks(Stamp& stamp) { return stamp.ranks_; }
    static std::uint64_t ranks(const Stamp& stamp) { return stamp.ranks_; }
    /// Of cuts, the hash of this rank's points if at least one of them has to leave; of a plan, the
    /// number of the call on this rank; 0: none.
    static std::uint64_t& points(Stamp& stamp) { return stamp.points_; }
    static std::uint64_t points(const Stamp& stamp) { return stamp.points_; }
};

}  // namespace rrcb::detail
