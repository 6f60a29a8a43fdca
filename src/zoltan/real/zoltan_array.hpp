#pragma once

#include <zoltan_mem.h>
#include <zoltan_types.h>

#include <cstddef>
#include <memory>
#include <new>

namespace rrcb::zoltan {

inline char* file_of_arrays() {
    return const_cast<char*>("zoltan_array.hpp");
}

struct ZoltanFree {
    void operator()(void* array) const { Zoltan_Free(&array, file_of_arrays(), __LINE__); }
};

/// An array from Zoltan's allocator, which Zoltan_LB_Free_Part can therefore free.
template <typename T>
using ZoltanArray = std::unique_ptr<T[], ZoltanFree>;

/// Returns an uninitialised array; null if `size` is 0. Throws std::bad_alloc.
template <typename T>
ZoltanArray<T> make_array(std::size_t size) {
    if (size == 0) return nullptr;
    void* const made = Zoltan_Malloc(size * sizeof(T), file_of_arrays(), __LINE__);
    if (made == nullptr) throw std::bad_alloc();
    return ZoltanArray<T>(static_cast<T*>(made));
}

/// Frees the memory after the first `size` entries of a longer array.
template <typename T>
void shrink(ZoltanArray<T>& array, std::size_t size) {
    if (size == 0) array.reset();
    if (!array) return;
    void* const shrunk = Zoltan_Realloc(array.get(), size * sizeof(T), file_of_arrays(), __LINE__);
    if (shrunk == nullptr) return;
    array.release();
    array.reset(static_cast<T*>(shrunk));
}

}  // namespace rrcb::zoltan
