#pragma once

#include <zoltan_mem.h>
#include <zoltan_types.h>

#include <cstddef>
#include <new>
#include <utility>

namespace rrcb::zoltan {

/// Array from Zoltan's allocator, so that Zoltan_LB_Free_Part can free the lists.
template <typename T>
class ZoltanArray {
  public:
    ZoltanArray() = default;
    /// Uninitialised; null if `size` is 0. Throws std::bad_alloc.
    explicit ZoltanArray(std::size_t size) {
        if (size == 0) return;
        data_ = reinterpret_cast<T*>(Zoltan_Malloc(size * sizeof(T), file(), __LINE__));
        if (data_ == nullptr) throw std::bad_alloc();
        size_ = size;
    }
    ZoltanArray(ZoltanArray&& other) noexcept
        : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
    ZoltanArray& operator=(ZoltanArray&& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        return *this;
    }
    ~ZoltanArray() { Zoltan_Free(reinterpret_cast<void**>(&data_), file(), __LINE__); }

    T* get() const { return data_; }
    T& operator[](std::size_t i) const { return data_[i]; }
    std::size_t size() const { return size_; }
    T* release() {
        size_ = 0;
        return std::exchange(data_, nullptr);
    }

    /// Frees the memory behind the first `size` entries.
    void shrink(std::size_t size) {
        if (size == 0) {
            *this = ZoltanArray();
        } else if (data_ != nullptr && size < size_) {
            T* shrunk =
                reinterpret_cast<T*>(Zoltan_Realloc(data_, size * sizeof(T), file(), __LINE__));
            if (shrunk != nullptr) data_ = shrunk;
            size_ = size;
        }
    }

  private:
    static char* file() { return const_cast<char*>("zoltan_array.hpp"); }

    T* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace rrcb::zoltan
