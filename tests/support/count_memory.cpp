// Counts what a program allocates, see virtual_search.hpp.
#include "virtual_search.hpp"

#include <malloc.h>

#include <cstdlib>
#include <new>

using rrcb::test::bytes_in_use;
using rrcb::test::most_bytes_in_use;

[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    void* memory = std::malloc(size);
    if (memory != nullptr) bytes_in_use += static_cast<std::int64_t>(malloc_usable_size(memory));
    most_bytes_in_use = std::max(most_bytes_in_use, bytes_in_use);
    return memory;
}
[[gnu::noinline]] void* operator new(std::size_t size) {
    if (void* memory = operator new(size, std::nothrow)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    bytes_in_use -= static_cast<std::int64_t>(malloc_usable_size(memory));
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    operator delete(memory);
}
