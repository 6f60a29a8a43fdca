#pragma once

#include <rrcb/error.hpp>
#include <rrcb/points.hpp>

#include <Kokkos_Core.hpp>

#include <cstdint>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

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

/// Returns a view of new memory; of zeros if `is_zero`. Throws std::bad_alloc.
template <class T, class Memory, class Execution>
Kokkos::View<T*, Memory> allocate(const Execution& exec, std::size_t size, bool is_zero = false) {
    using View = Kokkos::View<T*, Memory>;
    try {
        const std::string name = "rrcb";
        if (is_zero) return View(Kokkos::view_alloc(exec, name), size);
        return View(Kokkos::view_alloc(exec, name, Kokkos::WithoutInitializing), size);
    } catch (const std::exception&) {
        // Versions of Kokkos throw different types.
        throw std::bad_alloc();
    }
}

template <class T>
using HostView = Kokkos::View<T*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

/// Returns a copy of numbers of the host, which must stay until a fence.
template <class Memory, class Execution, class Values>
auto copy_in(const Execution& exec, const Values& values) {
    using T = typename Values::value_type;
    const auto view = allocate<T, Memory>(exec, values.size());
    if (!values.empty())
        Kokkos::deep_copy(exec, view, HostView<const T>(values.data(), values.size()));
    return view;
}

/// Copies the first `to.size()` numbers of a view to the host, where they are after a fence.
template <class Execution, class View, class T>
void copy_out(const Execution& exec, const View& view, std::span<T> to) {
    if (to.empty()) return;
    Kokkos::deep_copy(exec, HostView<T>(to.data(), to.size()),
                      Kokkos::subview(view, std::pair<std::size_t, std::size_t>(0, to.size())));
}

/// Returns the indices 0 ... count - 1 for a kernel, of 64 bits.
template <class Execution>
auto range(const Execution& exec, std::int64_t count) {
    return Kokkos::RangePolicy<Execution, Kokkos::IndexType<std::int64_t>>(exec, 0, count);
}

}  // namespace rrcb::detail
