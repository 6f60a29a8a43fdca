#pragma once

#include <mpi.h>
#include <mpm/particles.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace mpm {

/// How far points must travel. The largest value of all ranks applies.
enum class Reach { nowhere, neighbours, anywhere };

/// Owner of a point that has left the domain.
inline constexpr int nobody = -1;

/// The points that leave a rank: their local indices, ascending, and the rank that each is sent to,
/// or nobody.
struct Leavers {
    std::vector<std::size_t> points;
    std::vector<int> owners;
};

/// Sends the leavers with all their columns, in one message per receiver, and appends the points
/// that arrive, in ascending order of the sender. Removes the points sent to nobody.
///
/// Collective. `reach` must be the same on all ranks. With Reach::neighbours every pair of
/// `neighbours` (ascending and mutual) exchanges a message. With Reach::anywhere the ranks first
/// determine who sends to whom. Returns the number of points that arrived.
std::size_t migrate(Particles& particles, const Leavers& leavers, Reach reach,
                    std::span<const int> neighbours, MPI_Comm comm);

}  // namespace mpm
