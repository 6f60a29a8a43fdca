#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "lists/duplicated_mpi.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/plan.hpp>

#include <array>
#include <string>

namespace rrcb {

namespace {

void check_arguments(const Points& points, std::span<const Part> parts, int num_parts) {
    if (parts.size() != points.count)
        reject("parts has " + std::to_string(parts.size()) + " entries for " +
               std::to_string(points.count) + " points; give one per point");
    require(points.weights.empty() || points.weights.size() == points.count,
            "weights must hold one entry per point, or none for unit weights");
    check_parts(parts, num_parts);
}

/// Adds up numbers over all ranks. If a rank has failed or arguments differ, throws on all ranks.
/// Collective: an agreement and a reduction.
void add_up(std::span<double> sums, const Points& points, int num_parts, Participant& self) {
    agree(self, {{"num_parts", static_cast<std::uint64_t>(num_parts)}, weights_given(points)});
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE,
                             MPI_SUM, self.comm),
               "MPI_Allreduce");
}

}  // namespace

std::vector<double> part_weights(const Points& points, std::span<const Part> parts, int num_parts,
                                 Participant& self) {
    std::vector<double> weights;
    self.attempt([&] {
        check_arguments(points, parts, num_parts);
        weights.resize(num_parts);
        for (LocalIndex i = 0; i < points.count; ++i) weights[parts[i]] += points.weight(i);
    });
    add_up(weights, points, num_parts, self);
    return weights;
}

std::vector<double> part_weights(const Points& points, std::span<const Part> parts, int num_parts,
                                 MPI_Comm user) {
    Participant self = mpi::enter(user, CallName::part_weights);
    std::vector<double> weights = part_weights(points, parts, num_parts, self);
    self.throw_failed_message();
    return weights;
}

std::vector<double> part_weights(const Points& points, const Balance& balance, MPI_Comm comm) {
    return part_weights(points, balance.parts, balance.cuts.num_parts, comm);
}

double moved_fraction(const Points& points, std::span<const Part> parts, int num_parts,
                      Participant& self) {
    std::array<double, 2> sums{};  // weight that moves, total weight
    self.attempt([&] {
        check_arguments(points, parts, num_parts);
        const int rank = mpi::rank_of(self.comm);
        const int num_ranks = mpi::size_of(self.comm);
        for (LocalIndex i = 0; i < points.count; ++i) {
            const bool stays = ranks_of_part(parts[i], num_parts, num_ranks).contains(rank);
            if (!stays) sums[0] += points.weight(i);
            sums[1] += points.weight(i);
        }
    });
    add_up(sums, points, num_parts, self);
    return sums[1] == 0 ? 0 : sums[0] / sums[1];
}

double moved_fraction(const Points& points, std::span<const Part> parts, int num_parts,
                      MPI_Comm user) {
    Participant self = mpi::enter(user, CallName::moved_fraction);
    const double moved = moved_fraction(points, parts, num_parts, self);
    self.throw_failed_message();
    return moved;
}

double moved_fraction(const Points& points, const Balance& balance, MPI_Comm comm) {
    return moved_fraction(points, balance.parts, balance.cuts.num_parts, comm);
}

}  // namespace rrcb
