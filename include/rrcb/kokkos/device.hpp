#pragma once

#include <rrcb/error.hpp>
#include <rrcb/points.hpp>

#include <Kokkos_Core.hpp>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace rrcb::detail {

[[noreturn]] inline void reject_on_device(const std::string& what) {
    throw Error(ErrorCode::invalid_argument, what);
}

/// Throws Error unless Kokkos can run kernels.
inline void require_kokkos() {
    if (!Kokkos::is_initialized())
        reject_on_device(
            "Kokkos is not initialized; call Kokkos::initialize() before, and "
            "Kokkos::finalize() after all calls with views");
}

/// True for execution spaces that run on the host.
template <class Execution>
inline constexpr bool runs_on_host =
    std::is_same_v<typename Execution::memory_space, Kokkos::HostSpace>;

/// An instance of an execution space, and memory that the steps of a call share: views of it hold
/// their numbers until the next fence.
template <class Space, class MemorySpace>
class Device {
  public:
    using Execution = Space;
    using Memory = MemorySpace;
    template <class T>
    using Lent = Kokkos::View<T*, Memory, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

    explicit Device(const Execution& exec) : exec_(exec) {}

    const Execution& exec() const { return exec_; }

    /// Returns indices 0 ... count - 1, of 64 bits, for a kernel.
    auto range(std::int64_t count) const {
        return Kokkos::RangePolicy<Execution, Kokkos::IndexType<std::int64_t>>(exec_, 0, count);
    }

    /// Returns memory of its own for numbers. Throws std::bad_alloc.
    template <class T>
    Kokkos::View<T*, Memory> allocate(std::size_t size) const {
        try {
            const auto how =
                Kokkos::view_alloc(exec_, std::string("rrcb"), Kokkos::WithoutInitializing);
            return Kokkos::View<T*, Memory>(how, size);
        } catch (const std::exception&) {
            // Versions of Kokkos throw different types.
            throw std::bad_alloc();
        }
    }

    /// Returns shared memory for numbers. Throws std::bad_alloc.
    template <class T>
    Lent<T> lend(std::size_t size) {
        const std::size_t bytes = (size * sizeof(T) + alignment - 1) / alignment * alignment;
        if (lent_ + bytes > memory_.extent(0)) {
            full_.push_back(memory_);
            memory_ = allocate<char>(std::max(bytes, least_bytes));
            lent_ = 0;
        }
        T* const first = reinterpret_cast<T*>(memory_.data() + lent_);
        lent_ += bytes;
        return Lent<T>(first, size);
    }
    template <class T>
    Lent<T> lend_zeros(std::size_t size) {
        const Lent<T> view = lend<T>(size);
        Kokkos::deep_copy(exec_, view, T{});
        return view;
    }

    /// Copies numbers of the host, which must stay until the next fence, to a view.
    template <class Values, class View>
    void copy_in(const Values& values, const View& view) const {
        using T = typename Values::value_type;
        if (!values.empty())
            Kokkos::deep_copy(exec_, view, OnHost<const T>(values.data(), values.size()));
    }
    template <class Values>
    auto copy_in(const Values& values) {
        const auto view = lend<typename Values::value_type>(values.size());
        copy_in(values, view);
        return view;
    }
    /// Copies a view to as many numbers of the host, where they are after the next fence.
    template <class View, class T>
    void copy_out(const View& view, std::span<T> to) const {
        if (!to.empty()) Kokkos::deep_copy(exec_, OnHost<T>(to.data(), to.size()), view);
    }

    void fence() {
        exec_.fence();
        full_.clear();
        lent_ = 0;
    }

  private:
    template <class T>
    using OnHost = Kokkos::View<T*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

    static constexpr std::size_t alignment = 64;
    static constexpr std::size_t least_bytes = 1 << 18;  // those of the default mesh

    Execution exec_;
    Kokkos::View<char*, Memory> memory_{};
    std::size_t lent_ = 0;  ///< bytes
    std::vector<Kokkos::View<char*, Memory>> full_{};
};

}  // namespace rrcb::detail
