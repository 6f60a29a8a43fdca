// The public functions.
#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "lists/hungarian.hpp"
#include "lists/spread_remap_mpi.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace rrcb {

namespace {

void check_ranks(std::span<const RankRange> ranks_of_parts, int num_ranks) {
    require(!ranks_of_parts.empty(), "ranks_of_parts is empty; give one entry per part");
    require(std::ranges::all_of(ranks_of_parts,
                                [&](const RankRange& ranks) {
                                    return ranks.first_rank >= 0 && ranks.count >= 1 &&
                                           ranks.count <= num_ranks - ranks.first_rank;
                                }),
            "ranks_of_parts must name ranks of this communicator");
    require(std::ranges::is_sorted(ranks_of_parts, {}, &RankRange::first_rank),
            "ranks_of_parts must ascend");
}

void check_arguments(std::span<const Part> parts, const PreviousParts& previous,
                     std::size_t num_parts) {
    if (previous && previous->size() != parts.size())
        reject("previous has " + std::to_string(previous->size()) + " entries, parts has " +
               std::to_string(parts.size()) + "; give one of each per point");
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i] < 0 || static_cast<std::size_t>(parts[i]) >= num_parts)
            reject("part " + std::to_string(parts[i]) + " of point " + std::to_string(i) +
                   " is none of the " + std::to_string(num_parts) + " parts");
}

/// Room for a call, whoever finds the numbers.
struct Room {
    std::optional<RemapBuffers> buffers{};        ///< where one rank does, or
    std::optional<SpreadRemapRoom> spread{};      ///< where all do, with
    std::optional<ButterflyMessages> messages{};  ///< and
    std::vector<Part> numbers{};                  ///< of all parts
};

bool lie_evenly(std::span<const RankRange> ranks_of_parts, int num_ranks) {
    const int num_parts = static_cast<int>(ranks_of_parts.size());
    for (Part part = 0; part < num_parts; ++part) {
        const RankRange even = ranks_of_part(part, num_parts, num_ranks);
        const RankRange& range = ranks_of_parts[static_cast<std::size_t>(part)];
        if (even.count != 1 || range.first_rank != even.first_rank || range.count != 1)
            return false;
    }
    return true;
}

Room make_room(std::span<const RankRange> ranks_of_parts, Origins origins, MPI_Comm comm) {
    const int num_ranks = mpi::size_of(comm);
    const int num_parts = static_cast<int>(ranks_of_parts.size());
    Room room;
    if (num_ranks > most_ranks_of_gathered_overlaps && num_parts > most_parts_exact &&
        lie_evenly(ranks_of_parts, num_ranks)) {
        room.spread.emplace(num_parts, comm);
        room.messages.emplace();
        room.numbers.resize(ranks_of_parts.size());
    } else {
        room.buffers.emplace(num_parts, num_ranks, mpi::rank_of(comm) == root, origins);
    }
    return room;
}

/// Gives every rank all numbers, of which each knows those of its parts. Collective: two
/// reductions.
Remap complete(SpreadRemap&& found, std::vector<Part>&& numbers, Participant& self) {
    const int num_parts = static_cast<int>(numbers.size());
    if (found.summary.identity) std::iota(numbers.begin(), numbers.end(), 0);
    const auto [first, end] = parts_on(mpi::rank_of(self.comm), num_parts, mpi::size_of(self.comm));
    for (const auto& [part, number] : found.numbers)
        if (part >= first && part < end) numbers[static_cast<std::size_t>(part)] = number;
    agree(self);
    if (!found.summary.identity)
        mpi::check(
            MPI_Allreduce(MPI_IN_PLACE, numbers.data(), num_parts, MPI_INT, MPI_SUM, self.comm),
            "MPI_Allreduce");
    found.summary.numbers = std::move(numbers);
    return std::move(found.summary);
}

/// Checks the arguments, makes room and renumbers. Collective.
Remap remap_alone(std::span<const Part> parts, const PreviousParts& previous,
                  std::span<const RankRange> ranks_of_parts, MPI_Comm user) {
    Participant self{mpi::duplicate_of(user)};
    const Origins origins = previous ? Origins::parts : Origins::ranks;
    Room room;
    self.attempt([&] {
        check_ranks(ranks_of_parts, mpi::size_of(self.comm));
        check_arguments(parts, previous, ranks_of_parts.size());
        room = make_room(ranks_of_parts, origins, self.comm);
    });
    agree(self, {{"ranks_of_parts", hash_of(ranks_of_parts)}, {"previous", previous ? 1u : 0u}});
    if (room.buffers) return remap(parts, previous, ranks_of_parts, *room.buffers, self);
    return complete(remap_spread(parts, origins, previous, *room.spread, *room.messages, self),
                    std::move(room.numbers), self);
}

}  // namespace

Remap remap(std::span<const Part> parts, std::span<const RankRange> ranks_of_parts, MPI_Comm user) {
    return remap_alone(parts, std::nullopt, ranks_of_parts, user);
}

Remap remap(std::span<const Part> parts, std::span<const Part> previous,
            std::span<const RankRange> ranks_of_parts, MPI_Comm user) {
    return remap_alone(parts, previous, ranks_of_parts, user);
}

}  // namespace rrcb
