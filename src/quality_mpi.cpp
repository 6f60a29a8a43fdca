#include "agreement_mpi.hpp"
#include "mpi/communicator.hpp"
#include "mpi/duplicate.hpp"

#include <rrcb/error.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/quality.hpp>

#include <algorithm>
#include <array>
#include <string>

namespace rrcb {

namespace {

void check_arguments(const Points& points, std::span<const Part> parts, int num_parts) {
    if (parts.size() != points.count)
        throw Error(ErrorCode::invalid_argument,
                    "parts has " + std::to_string(parts.size()) + " entries for " +
                        std::to_string(points.count) + " points; give one per point");
    for (const Part part : parts)
        if (part < 0 || part >= num_parts)
            throw Error(ErrorCode::invalid_argument, "part " + std::to_string(part) +
                                                         " is none of the " +
                                                         std::to_string(num_parts) + " parts");
}

std::vector<double> weights_here(const Points& points, std::span<const Part> parts, int num_parts) {
    check_arguments(points, parts, num_parts);
    std::vector<double> weights(static_cast<std::size_t>(num_parts));
    for (LocalIndex i = 0; i < points.count; ++i)
        weights[static_cast<std::size_t>(parts[i])] += points.weight(i);
    return weights;
}

}  // namespace

std::vector<double> part_weights(const Points& points, std::span<const Part> parts, int num_parts,
                                 MPI_Comm user) {
    Member me{mpi::duplicate_of(user)};
    std::vector<double> weights;
    me.locally([&] { weights = weights_here(points, parts, num_parts); });
    // In pieces, for which every rank has the memory; the first entry counts the failing ranks.
    std::array<double, 1024> piece;
    const auto count = static_cast<std::size_t>(std::max(0, num_parts));
    std::size_t first = 0;
    do {
        const std::size_t size = std::min(count - first, piece.size() - 1);
        piece.fill(0);
        piece[0] = me.failure.failed ? 1 : 0;
        if (!me.failure.failed) std::copy_n(weights.data() + first, size, piece.data() + 1);
        mpi::check(MPI_Allreduce(MPI_IN_PLACE, piece.data(), static_cast<int>(size + 1), MPI_DOUBLE,
                                 MPI_SUM, me.comm),
                   "MPI_Allreduce");
        if (piece[0] > 0) agree(me);
        std::copy_n(piece.data() + 1, size, weights.data() + first);
        first += size;
    } while (first < count);
    return weights;
}

double moved_fraction(const Points& points, std::span<const Part> parts, int num_parts,
                      MPI_Comm user) {
    Member me{mpi::duplicate_of(user)};
    std::array<double, 3> sums{};  // weight that moves, all weight, ranks that failed
    me.locally([&] {
        check_arguments(points, parts, num_parts);
        const int rank = mpi::rank_of(me.comm);
        const int num_ranks = mpi::size_of(me.comm);
        for (LocalIndex i = 0; i < points.count; ++i) {
            const RankRange ranks = ranks_of_part(parts[i], num_parts, num_ranks);
            const bool stays = rank >= ranks.first && rank < ranks.first + ranks.count;
            if (!stays) sums[0] += points.weight(i);
            sums[1] += points.weight(i);
        }
    });
    sums[2] = me.failure.failed ? 1 : 0;
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE,
                             MPI_SUM, me.comm),
               "MPI_Allreduce");
    if (sums[2] > 0) agree(me);
    return sums[1] > 0 ? sums[0] / sums[1] : 0;
}

}  // namespace rrcb
