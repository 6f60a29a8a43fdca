#pragma once

#include "collective/exchange_mpi.hpp"

#include <rrcb/detail/uninitialized.hpp>
#include <rrcb/points.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rrcb::zoltan {

/// Memory that grows and is kept, so that repeated calls touch the same pages.
template <typename T>
struct Scratch : private detail::Uninitialized<T> {
    /// Returns room for `size` entries. Old entries are lost. Throws std::bad_alloc.
    T* get(std::size_t size) {
        this->clear();
        this->resize(size);
        return detail::Uninitialized<T>::data();
    }
    using detail::Uninitialized<T>::data;  ///< null before the first get()
};

/// Memory that one handle's calls share.
struct Workspace {
    Scratch<double> coordinates;
    Scratch<double> weights;
    Scratch<float> callback_weights;
    Scratch<std::uint32_t> global_ids;
    Scratch<std::uint32_t> local_ids;
    Scratch<int> initial_parts;
    Scratch<int> moving;  ///< indices of objects that move
    std::vector<Part> parts;
    ExchangeBuffers records;  ///< of objects that move
};

}  // namespace rrcb::zoltan
