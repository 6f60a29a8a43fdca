#include "zoltan/call/look_ups_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "cuts/gather_cuts_mpi.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace rrcb::zoltan {

namespace {

/// Of parts, up to which 256 kB of cuts on each rank cost less than what it takes to share them.
constexpr int most_parts_alone = 8192;

/// Makes room for the cuts on each machine, where what there is does not fit. Collective.
void make_room(int num_parts, std::unique_ptr<NodeCuts>& room, Participant& self) {
    if (room && room->tree().size() + 1 == static_cast<std::size_t>(num_parts)) return;
    room.reset();
    self.attempt([&] { room = std::make_unique<NodeCuts>(); });
    agree(self);
    room->make_room(num_parts, self);
}

}  // namespace

void show_all_cuts(const Outcome& outcome, const Cuts& cuts, State& state, KeptPartition& kept,
                   Participant& self) {
    if (!outcome.any_keeps_cuts || is_whole(cuts)) return;
    if (cuts.num_parts <= most_parts_alone) return kept.show_all(gather_cuts(cuts, self).tree);
    make_room(cuts.num_parts, state.node_cuts, self);
    state.node_cuts->gather(cuts, self);
    kept.show_all(state.node_cuts->tree());
}

Numbering whole_numbering(const Numbering& numbering, const PartMap& map, Participant& self) {
    std::vector<Part> numbers;
    std::vector<Part> room;
    self.attempt([&] {
        numbers.resize(static_cast<std::size_t>(map.num_parts));
        room.resize(numbers.size());
    });
    agree(self);
    const auto [first, end] = map.parts_on(mpi::rank_of(self.comm));
    for (Part part = first; part < end; ++part)
        numbers[static_cast<std::size_t>(part)] = numbering.number_of(part);
    mpi::check(
        MPI_Allreduce(MPI_IN_PLACE, numbers.data(), map.num_parts, MPI_INT, MPI_SUM, self.comm),
        "MPI_Allreduce");
    return Numbering::of_all(std::move(numbers), std::move(room));
}

}  // namespace rrcb::zoltan
