#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace rrcb {
namespace detail {

/// Leaves new entries uninitialized, because they are overwritten at once.
template <class Value>
struct UninitializedAllocator : std::allocator<Value> {
    template <class Other>
    struct rebind {
        using other = UninitializedAllocator<Other>;
    };

    template <class... Arguments>
    void construct(Value* place, Arguments&&... arguments) {
        if constexpr (sizeof...(arguments) > 0)
            std::construct_at(place, std::forward<Arguments>(arguments)...);
        else
            ::new (static_cast<void*>(place)) Value;
    }
};

/// A vector whose resize() does not write new entries.
template <class Value>
using Uninitialized = std::vector<Value, UninitializedAllocator<Value>>;

}  // namespace detail
}  // namespace rrcb
