#include "mpi/communicator.hpp"
#include "mpi/duplicate.hpp"

#include <rrcb/plan.hpp>
#include <rrcb/quality.hpp>

#include <array>

namespace rrcb {

std::vector<double> part_weights(const Points& points, std::span<const Part> parts, int num_parts,
                                 MPI_Comm user) {
    const MPI_Comm comm = mpi::duplicate_of(user);
    std::vector<double> weights(static_cast<std::size_t>(num_parts));
    for (LocalIndex i = 0; i < points.count; ++i)
        weights[static_cast<std::size_t>(parts[i])] += points.weight(i);
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, weights.data(), num_parts, MPI_DOUBLE, MPI_SUM, comm),
               "MPI_Allreduce");
    return weights;
}

double moved_fraction(const Points& points, std::span<const Part> parts, int num_parts,
                      MPI_Comm user) {
    const MPI_Comm comm = mpi::duplicate_of(user);
    const int rank = mpi::rank_of(comm);
    const int num_ranks = mpi::size_of(comm);
    std::array<double, 2> moved_and_all{};
    for (LocalIndex i = 0; i < points.count; ++i) {
        const RankRange ranks = ranks_of_part(parts[i], num_parts, num_ranks);
        const bool stays = rank >= ranks.first && rank < ranks.first + ranks.count;
        if (!stays) moved_and_all[0] += points.weight(i);
        moved_and_all[1] += points.weight(i);
    }
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, moved_and_all.data(), 2, MPI_DOUBLE, MPI_SUM, comm),
               "MPI_Allreduce");
    return moved_and_all[1] > 0 ? moved_and_all[0] / moved_and_all[1] : 0;
}

}  // namespace rrcb
