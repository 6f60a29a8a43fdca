#pragma once

#include "collective/exchange_mpi.hpp"

#include <rrcb/detail/uninitialized.hpp>
#include <rrcb/points.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rrcb::zoltan {

/// Returns room for `size` entries in memory that grows and is kept, so that repeated calls touch
/// the same pages. Old entries are lost. Throws std::bad_alloc.
template <typename T>
T* room_in(detail::Uninitialized<T>& memory, std::size_t size) {
    memory.clear();
    memory.resize(size);
    return memory.data();
}

/// Memory shared by one handle's calls.
struct Workspace {
    detail::Uninitialized<double> coordinates;
    detail::Uninitialized<double> weights;
    detail::Uninitialized<float> callback_weights;
    detail::Uninitialized<std::uint32_t> global_ids;
    detail::Uninitialized<std::uint32_t> local_ids;
    detail::Uninitialized<int> initial_parts;
    detail::Uninitialized<int> moving;  ///< indices of moving objects
    std::vector<Part> parts;
    ExchangeBuffers records;  ///< of moving objects
};

}  // namespace rrcb::zoltan
