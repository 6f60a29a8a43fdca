#pragma once

#include "collective/exchange_mpi.hpp"

#include <rrcb/detail/uninitialized.hpp>
#include <rrcb/points.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rrcb::zoltan {

/// Returns memory for `size` entries. The memory grows and is kept, so that repeated calls use the
/// same pages. Old entries are lost. Throws std::bad_alloc.
template <typename T>
T* room_in(detail::Uninitialized<T>& memory, std::size_t size) {
    memory.clear();
    memory.resize(size);
    return memory.data();
}

/// Memory that the calls of one handle share.
struct Workspace {
    detail::Uninitialized<double> coordinates;
    detail::Uninitialized<double> weights;
    detail::Uninitialized<float> callback_weights;
    detail::Uninitialized<std::uint32_t> global_ids;
    detail::Uninitialized<std::uint32_t> local_ids;
    detail::Uninitialized<int> initial_parts;
    detail::Uninitialized<int> moving;  ///< indices of moving objects
    std::vector<Part> parts;
    ExchangeBuffers records;  ///< buffers for sending moving objects
};

}  // namespace rrcb::zoltan
