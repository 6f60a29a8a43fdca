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

/// Returns on every rank the state that write() produces on rank 0, followed by three numbers of
/// each rank. `wait` is called on every rank between the messages. Collective.
std::vector<std::byte> save_together(StateKind kind, const std::array<double, 3>& mine,
                                     const std::function<void()>& wait,
                                     const std::function<void(SavedState&)>& write,
                                     Participant& self);

/// Reads the numbers of a rank, which are at the end of the state.
std::array<double, 3> numbers_of_rank(SavedState& state, int rank);

std::uint64_t hash_of_bytes(std::span<const std::byte> bytes);

}  // namespace rrcb
