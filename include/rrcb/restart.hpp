#pragma once

#include <rrcb/controller.hpp>
#include <rrcb/cuts.hpp>

#include <mpi.h>

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace rrcb {

namespace detail {

/// Saves and loads what has private members.
struct Restart {
    RRCB_API static std::vector<std::byte> save(const Controller& controller);
    RRCB_API static Controller load_controller(std::span<const std::byte> bytes, MPI_Comm comm);
};
RRCB_API Cuts load_cuts(std::span<const std::byte> bytes);

}  // namespace detail

/// Returns cuts as bytes, which a program may store and load() on any machine. Not collective.
///
/// Throws Error if they are no tree.
RRCB_API std::vector<std::byte> save(const Cuts& cuts);

/// Returns the state of a controller as bytes, the same on every rank. Collective over its ranks,
/// and waits for the steps of all of them; the controller is not changed.
///
/// At most 1 kB for cycles of 500 steps on 8 ranks: 24 bytes more for each rank, 80 for twice the
/// steps. Throws Error on every rank alike if there is no memory, or as step().
inline std::vector<std::byte> save(const Controller& controller) {
    return detail::Restart::save(controller);
}

/// Restores a saved state: Cuts, not collective, or a Controller, collective.
///
///     std::vector<std::byte> state = rrcb::save(controller);  // to be written by one rank
///     controller = rrcb::load<rrcb::Controller>(state, comm);
///
/// On as many ranks as before a controller goes on with the same bits. On another number it begins
/// anew. Cuts keep their number of parts; on other ranks balance() ignores them unless
/// Options::num_parts is that number.
/// @param bytes of save(), the same on every rank, in either byte order
/// @param comm  as for the constructors; ignored for Cuts
/// Throws Error, collective ones on every rank alike, if the bytes are truncated, of another kind,
/// or from a newer version.
template <class State>
[[nodiscard]] State load(std::span<const std::byte> bytes, MPI_Comm comm) {
    if constexpr (std::is_same_v<State, Controller>)
        return detail::Restart::load_controller(bytes, comm);
    if constexpr (std::is_same_v<State, Cuts>) return detail::load_cuts(bytes);
}

/// Restores cuts. Not collective.
///
/// @param bytes as above
template <class State>
requires std::is_same_v<State, Cuts>
[[nodiscard]] State load(std::span<const std::byte> bytes) {
    return detail::load_cuts(bytes);
}

}  // namespace rrcb
