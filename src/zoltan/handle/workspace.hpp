#pragma once

#include "collective/exchange_mpi.hpp"

#include <rrcb/points.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace rrcb::zoltan {

/// Uninitialised memory that grows and is kept, so that repeated calls touch the same pages.
template <typename T>
class Scratch {
  public:
    /// Returns room for `size` entries. Old entries are lost if it grows. Throws std::bad_alloc.
    T* get(std::size_t size) {
        if (size > capacity_) {
            data_ = std::make_unique_for_overwrite<T[]>(size);
            capacity_ = size;
        }
        return data_.get();
    }
    const T* data() const { return data_.get(); }  ///< null before the first get

  private:
    std::unique_ptr<T[]> data_;
    std::size_t capacity_ = 0;
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
