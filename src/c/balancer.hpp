#pragma once

#include "collective/duplicate.hpp"
#include "collective/failure.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/rrcb.h>

#include <mpi.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

/// The object that a C program's pointer refers to.
struct rrcb_balancer {
    static constexpr const char* name = "balancer";
    MPI_Comm comm = MPI_COMM_NULL;
    rrcb::Options options{};
    mutable rrcb::Cuts cuts{};  ///< mutable, because rrcb_assign_all notes its points in it
    std::optional<rrcb::Report> report{};
    std::optional<rrcb::Plan> plan{};
    std::vector<std::byte> saved{};
    /// Least number of points in the balance and in the look-ups after it. A plan for fewer points
    /// would lose some.
    mutable std::atomic<std::size_t> least_count{no_count};
    static constexpr std::size_t no_count = std::numeric_limits<std::size_t>::max();

    void lower_count(std::size_t count) const {
        std::size_t least = least_count;
        while (count < least && !least_count.compare_exchange_weak(least, count)) {
        }
    }
};

namespace rrcb::c {

/// The call that failed last on this thread.
struct Origin {
    MPI_Comm comm = MPI_COMM_NULL;  ///< communicator of the caller; null if the call has none
    /// When the program ends: longest wait for other ranks on which the same call may have failed.
    std::chrono::seconds patience{1};
};

/// The same for a collective call. It is longer, because other ranks reach the end of the call late
/// only if the machine is busy.
inline constexpr std::chrono::seconds patience_together{60};

/// Keeps the text of a failure for this thread, and returns its code.
int code_of(const Failure& failure, const Origin& origin) noexcept;
Origin origin_of_last_failure() noexcept;

/// Runs the body of a function of the C interface and returns its code. No exception leaves it.
template <class Body>
int guarded(Body&& body, const Origin& origin = {}) noexcept {
    return code_of(attempt(body), origin);
}

/// Throws Error if a pointer is null.
void require(const void* pointer, const char* name);

/// As require(), for an array; an empty one may be null.
void require_array(std::size_t count, const void* values, const char* name);

/// Returns the bytes passed to a call. Returns none if their address is null, and load() then
/// throws.
inline std::span<const std::byte> saved_bytes(const void* bytes, std::size_t size) {
    return {static_cast<const std::byte*>(bytes), bytes == nullptr ? 0 : size};
}

/// Writes the address and size of saved bytes to the caller's variables. The bytes must remain in
/// place as long as the caller reads them.
inline void show(const std::vector<std::byte>& saved, const void** bytes, std::size_t* size) {
    *bytes = saved.data();
    *size = saved.size();
}

/// Returns a view of the points passed to a call. Throws Error if they are null or have no
/// coordinates.
Points points_of(const rrcb_points* points);

/// Returns a view of an array, empty if it is null.
template <class T>
std::span<const T> view(const T* values, std::size_t count) {
    return values == nullptr ? std::span<const T>() : std::span(values, count);
}

/// Returns the communicator of a Fortran program's handle, or MPI_COMM_NULL if MPI is not running.
/// MPI's standard ABI has no MPI_Comm_f2c.
inline MPI_Comm comm_of(int comm) {
    if (!mpi::is_running()) return MPI_COMM_NULL;
#ifdef MPI_ABI_VERSION
    return MPI_Comm_fromint(comm);
#else
    return MPI_Comm_f2c(comm);
#endif
}

/// Throw Error unless the balancer has cuts; cuts of `num_parts` parts; a plan.
void require_cuts(const rrcb_balancer& own);
void require_parts(const rrcb_balancer& own, std::size_t num_parts);
void require_plan(const rrcb_balancer& own);

/// Returns the number of points that this rank has after a plan.
inline LocalIndex num_points_after(const Plan& plan) {
    return plan.num_points - plan.export_indices.size() + plan.import_indices.size();
}

/// Throws Error if a handle is null.
void require_handle(const void* handle, const char* name);

/// Returns the origin of failures in a function that belongs to a handle.
template <class Handle>
Origin origin_in(const Handle* handle) noexcept {
    if constexpr (requires { handle->comm; }) {
        if (handle != nullptr) return {handle->comm};
    }
    return {};
}

/// Runs the body of a function that belongs to a handle. No exception leaves it.
template <class Handle, class Body>
int guarded(Handle* handle, Body&& body) noexcept {
    return guarded(
        [&] {
            require_handle(handle, Handle::name);
            body(*handle);
        },
        origin_in(handle));
}

/// Frees a handle, if there is one, and sets the caller's pointer to null.
template <class Handle>
void destroy(Handle** handle) noexcept {
    if (handle != nullptr) delete std::exchange(*handle, nullptr);
}

}  // namespace rrcb::c
