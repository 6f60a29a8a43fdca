#pragma once

#include <rrcb/error.hpp>
#include <rrcb/points.hpp>

#include <Kokkos_Core.hpp>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <mutex>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

namespace rrcb::detail {

/// Throws Error unless a condition is true.
inline void require_on_device(bool holds, const std::string& what) {
    if (!holds) throw Error(ErrorCode::invalid_argument, what);
}

inline void require_kokkos() {
    require_on_device(Kokkos::is_initialized(),
                      "Kokkos is not initialized; call Kokkos::initialize() before, and "
                      "Kokkos::finalize() after all calls with views");
}

template <class Execution>
concept KokkosSpace = Kokkos::is_execution_space<Execution>::value;

/// True for execution spaces that run on the host.
template <class Execution>
inline constexpr bool runs_on_host =
    std::is_same_v<typename Execution::memory_space, Kokkos::HostSpace>;

/// Returns a lock for kernels that use scratch memory, because before Kokkos 4 all threads of a
/// host share one scratch memory.
template <class Execution>
std::unique_lock<std::mutex> lock_scratch() {
    static std::mutex mutex;
    constexpr bool is_shared = runs_on_host<Execution> && KOKKOS_VERSION < 40000;
    return is_shared ? std::unique_lock(mutex) : std::unique_lock<std::mutex>();
}

/// An instance of an execution space, and memory that the steps of a call share. Views of this
/// memory are valid until the next fence.
template <class Space, class Memory>
class Device {
  public:
    using Execution = Space;
    template <class T>
    using Lent = Kokkos::View<T*, Memory, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

    /// Uses the memory of an earlier call, if it is given; see memory().
    explicit Device(const Execution& exec, const Kokkos::View<char*, Memory>& memory = {})
        : exec_(exec), memory_(memory) {}

    const Execution& exec() const { return exec_; }
    const Kokkos::View<char*, Memory>& memory() const { return memory_; }

    /// Returns the range of indices 0 ... count - 1 for a kernel, with 64 bits.
    auto range(std::size_t count) const {
        return Kokkos::RangePolicy<Execution, Kokkos::IndexType<std::int64_t>>(
            exec_, 0, static_cast<std::int64_t>(count));
    }

    /// Returns newly allocated memory. Throws std::bad_alloc.
    template <class T>
    Kokkos::View<T*, Memory> allocate(std::size_t size) const {
        try {
            const std::string name = "rrcb";
            return Kokkos::View<T*, Memory>(
                Kokkos::view_alloc(exec_, name, Kokkos::WithoutInitializing), size);
        } catch (const std::exception&) {
            // The type of the exception depends on the version of Kokkos.
            throw std::bad_alloc();
        }
    }

    /// Returns a part of the shared memory. Throws std::bad_alloc.
    template <class T>
    Lent<T> lend(std::size_t size) {
        constexpr std::size_t alignment = 64;
        constexpr std::size_t least_bytes = 1 << 18;  // enough for the default mesh
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

    /// Returns a copy of numbers of the host on the device. The numbers must remain until the next
    /// fence.
    template <class Values>
    auto copy_in(const Values& values) {
        using T = typename Values::value_type;
        const Lent<T> view = lend<T>(values.size());
        if (!values.empty())
            Kokkos::deep_copy(exec_, view, OnHost<const T>(values.data(), values.size()));
        return view;
    }
    /// Returns a copy on the host. Ends with a fence.
    template <class View>
    auto copy_out(const View& view) {
        using T = typename View::non_const_value_type;
        std::vector<T> values(view.extent(0));
        if (!values.empty())
            Kokkos::deep_copy(exec_, OnHost<T>(values.data(), values.size()), view);
        fence();
        return values;
    }

    void fence() {
        exec_.fence();
        full_.clear();
        lent_ = 0;
    }

  private:
    template <class T>
    using OnHost = Kokkos::View<T*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

    Execution exec_;
    Kokkos::View<char*, Memory> memory_{};
    std::size_t lent_ = 0;  ///< bytes in use
    std::vector<Kokkos::View<char*, Memory>> full_{};
};

}  // namespace rrcb::detail
