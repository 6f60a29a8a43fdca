#include "memory_layer.hpp"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace memory_layer {

namespace {

thread_local long failing_allocation = 0;
thread_local Shortage failing = Shortage::once;
thread_local long num_counted = 0;
thread_local long bytes_counted = 0;
thread_local long num_live = 0;
thread_local long bytes_live = 0;
thread_local long bytes_before = 0;
thread_local long bytes_at_peak = 0;
thread_local bool has_ended = false;

}  // namespace

bool next_fails(std::size_t bytes) {
    if (has_ended) return false;
    ++num_counted;
    bytes_counted += static_cast<long>(bytes);
    if (failing_allocation == 0) return false;
    return num_counted == failing_allocation ||
           (failing == Shortage::lasting && num_counted > failing_allocation);
}

void fail_allocation(long number, Shortage shortage) {
    failing_allocation = number;
    failing = shortage;
    num_counted = 0;
    bytes_counted = 0;
    has_ended = false;
}

void end_shortage() {
    has_ended = true;
}

long counted_allocations() {
    return num_counted;
}

long counted_bytes() {
    return bytes_counted;
}

long live_blocks() {
    return num_live;
}

long live_bytes() {
    return bytes_live;
}

long peak_bytes() {
    return bytes_at_peak - bytes_before;
}

void restart_peak() {
    bytes_before = bytes_at_peak = bytes_live;
}

void note(void* block, int sign) {
    num_live += sign;
    bytes_live += sign * static_cast<long>(malloc_usable_size(block));
    bytes_at_peak = std::max(bytes_at_peak, bytes_live);
}

}  // namespace memory_layer

void* operator new(std::size_t size) {
    void* block = memory_layer::next_fails(size) ? nullptr : std::malloc(size == 0 ? 1 : size);
    if (block == nullptr) throw std::bad_alloc();
    memory_layer::note(block, 1);
    return block;
}

// As the standard library has it; sanitizers bring one of their own.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    try {
        return operator new(size);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

void operator delete(void* block) noexcept {
    if (block != nullptr) memory_layer::note(block, -1);
    std::free(block);
}

void operator delete(void* block, std::size_t) noexcept {
    operator delete(block);
}
