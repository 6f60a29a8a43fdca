#include "cuts/locate_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "cuts/direct_assignment.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <rrcb/locate.hpp>

#include <cstdint>
#include <optional>

namespace rrcb {

PathSearchRoom::PathSearchRoom(const Cuts& known, const Points& points, std::span<Part> parts,
                               MPI_Comm comm)
    : search(known, points, parts),
      shared(mpi::rank_of(comm), mpi::size_of(comm), PathSearch::join_cuts),
      asked(mpi::rank_of(comm), mpi::size_of(comm), PathSearch::join_questions) {
    search.share(shared);
}

Cuts search_together(PathSearchRoom& room, Participant& self) {
    for (bool is_shared = false;; is_shared = true) {
        bool asks = false;
        self.attempt([&] {
            room.asked.clear();
            asks = room.search.ask(room.asked);
        });
        room.messages.run(room.asked, Butterfly::to_owners, {0, asks ? 1.0 : 0.0}, self);
        if (room.asked.flags()[1] == 0) return room.search.take();
        if (!is_shared) room.messages.run(room.shared, Butterfly::to_owners, {}, self);
        self.attempt([&] { room.search.answer(room.shared, room.asked); });
        room.messages.run(room.asked, Butterfly::back, {}, self);
        self.attempt([&] { room.search.learn(room.asked); });
    }
}

std::vector<Part> locate(const Cuts& cuts, const Points& positions, MPI_Comm user) {
    Participant self{mpi::duplicate_of(user)};
    std::vector<Part> parts;
    std::optional<PathSearchRoom> room;
    self.attempt([&] {
        check_tree(cuts);
        check_points(positions);
        require(positions.dimension == cuts.dimension,
                "positions must have the dimension of the cuts");
        parts.resize(positions.count);
        assign_known(cuts, positions, parts);
        if (!is_whole(cuts)) room.emplace(cuts, positions, parts, self.comm);
    });
    agree(self, {{"the dimension of the cuts", static_cast<std::uint64_t>(cuts.dimension)},
                 {"the number of parts", static_cast<std::uint64_t>(cuts.num_parts)},
                 {"whether the tree is whole", is_whole(cuts) ? 1u : 0u}});
    if (room) search_together(*room, self);
    return parts;
}

}  // namespace rrcb
