#pragma once

#include "collective/participant.hpp"
#include "collective/saved_state.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rrcb {

/// Returns the state that rank 0 writes, with three numbers of each rank, on every rank.
/// Collective. `wait` is called between, on every rank.
std::vector<std::byte> save_together(StateKind kind, const std::array<double, 3>& mine,
                                     const std::function<void()>& wait,
                                     const std::function<void(SavedState&)>& write,
                                     Participant& self);

/// Reads the numbers of a rank, which follow all else.
std::array<double, 3> numbers_of_rank(SavedState& state, int rank);

std::uint64_t hash_of_bytes(std::span<const std::byte> bytes);

}  // namespace rrcb
