#pragma once

#include <rrcb/groups.hpp>

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rrcb::experimental {

/// Returns one key for each point of overlapping groups: the same for points sharing a key,
/// directly or through other points, over all ranks. Collective.
///
///     const auto joined = rrcb::experimental::join_keys(keys, 2, comm);
///     const rrcb::Groups wells = rrcb::groups(points, joined, comm);
///
/// @param keys           `keys_per_point` for each point, no_group in place of missing ones
/// @param keys_per_point 1 or more, the same on every rank
/// @param comm           of the ranks with points
/// @return the least key of the joined groups, no_group for a point without keys
/// Throws Error on every rank alike: for keys of another length, or no memory. Cost: two exchanges,
/// as of groups(), and as many more as joined groups pass from one rank to the next.
[[nodiscard]] RRCB_API std::vector<std::uint64_t> join_keys(std::span<const std::uint64_t> keys,
                                                            std::size_t keys_per_point,
                                                            MPI_Comm comm);

}  // namespace rrcb::experimental
