#pragma once

#include <mpi.h>
#include <mpm/particles.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace mpm {

/// Distance that points must travel. The largest over all ranks decides.
enum class Reach { nowhere, neighbours, anywhere };

/// Owner of a point that has left the domain.
inline constexpr int nobody = -1;

/// Points that leave a rank: local indices, ascending, and the rank each goes to, or nobody.
struct Leavers {
    std::vector<std::size_t> points;
    std::vector<int> owners;
};

/// Sends the leavers with all their columns, one message per receiver, and appends the points
/// that arrive, in ascending order of the sender. Removes the points of nobody.
///
/// Collective. `reach` is the same on all ranks. Within `neighbours` (ascending, mutual) each pair
/// exchanges a message. Beyond, ranks first exchange who sends to whom. Returns the number of
/// points that arrived.
std::size_t migrate(Particles& particles, const Leavers& leavers, Reach reach,
                    std::span<const int> neighbours, MPI_Comm comm);

}  // namespace mpm
