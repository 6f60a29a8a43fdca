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

/// Saves and loads objects with private members.
struct Restart {
    RRCB_API static std::vector<std::byte> save(const Controller& controller);
    RRCB_API static Controller load_controller(std::span<const std::byte> bytes, MPI_Comm comm);
};
RRCB_API Cuts load_cuts(std::span<const std::byte> bytes);

}  // namespace detail

/// Returns cuts as bytes. A program may store them, and load() them on any machine. Not collective.
///
/// Throws Error if the cuts are not a tree.
RRCB_API std::vector<std::byte> save(const Cuts& cuts);

/// Returns the state of a controller as bytes, which are the same on every rank. Collective over
/// its ranks. Waits for the steps of all of them; the controller is not changed.
///
/// For cycles of 500 steps on 8 ranks it has at most 1 kB. Each further rank adds 24 bytes, and
/// each doubling of the steps adds 80. Throws the same Error on every rank if there is no memory,
/// or as step().
inline std::vector<std::byte> save(const Controller& controller) {
    return detail::Restart::save(controller);
}

/// Restores a Controller. Collective.
///
///     std::vector<std::byte> state = rrcb::save(controller);  // to be written by one rank
///     controller = rrcb::load<rrcb::Controller>(state, comm);
///
/// On the same number of ranks, a controller continues with bit-identical results; on another
/// number it starts anew.
/// @param bytes from save(), the same on every rank, in either byte order
/// @param comm  as for the constructors
/// Throws Error on every rank if the bytes are truncated, of another kind, or from a newer version.
template <class State>
requires(!std::is_same_v<State, Cuts>) [[nodiscard]] State
    load(std::span<const std::byte> bytes, MPI_Comm comm) {
    if constexpr (std::is_same_v<State, Controller>)
        return detail::Restart::load_controller(bytes, comm);
}

/// Restores cuts. Not collective.
///
/// They keep their number of parts; on another number of ranks balance() ignores them, unless
/// Options::num_parts is that number of parts. Throws Error as above.
/// @param bytes as above
template <class State>
requires std::is_same_v<State, Cuts>
[[nodiscard]] State load(std::span<const std::byte> bytes) {
    return detail::load_cuts(bytes);
}

}  // namespace rrcb
