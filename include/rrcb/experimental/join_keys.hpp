#pragma once

#include <rrcb/groups.hpp>

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rrcb::experimental {

/// Returns one key for each point of overlapping groups, over all ranks. Points get the same key if
/// they share a key directly or through other points. Collective.
///
///     const auto joined = rrcb::experimental::join_keys(keys, 2, comm);
///     const rrcb::Groups wells = rrcb::groups(points, joined, comm);
///
/// @param keys           `keys_per_point` for each point; no_group in place of missing ones
/// @param keys_per_point 1 or more, the same on every rank
/// @param comm           of the ranks with points
/// @return the least key of the joined groups; no_group for a point without keys
/// Throws the same Error on every rank: for keys of another length, or lack of memory. Cost: two
/// exchanges as those of groups(), repeated for each rank through which a chain of joined groups
/// passes.
[[nodiscard]] RRCB_API std::vector<std::uint64_t> join_keys(std::span<const std::uint64_t> keys,
                                                            std::size_t keys_per_point,
                                                            MPI_Comm comm);

}  // namespace rrcb::experimental
