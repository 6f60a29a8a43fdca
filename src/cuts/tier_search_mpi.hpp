#pragma once

#include "collective/butterfly_mpi.hpp"
#include "collective/communicator.hpp"

#include <utility>

namespace rrcb {

/// What a rank needs to take part in a search for cuts: that of a class derived from TierSearch,
/// whose ask(asked) asks for what it lacks, and returns whether it does.
template <class Search>
struct SearchRoom {
    /// Throws Error where the rank lacks a cut that it owns.
    SearchRoom(Search made, MPI_Comm comm)
        : search(std::move(made)),
          shared(mpi::rank_of(comm), mpi::size_of(comm), Search::join_cuts),
          asked(mpi::rank_of(comm), mpi::size_of(comm), Search::join_questions) {
        search.share(shared);
    }

    Search search;
    Butterfly shared;
    Butterfly asked;
    ButterflyMessages messages{};
};

/// Asks until no rank lacks cuts; returns whether any did.
///
/// Collective: a pass through the ranks where none asks. Otherwise one to share cuts, two for each
/// time that some rank asks, and one to end. All ranks have made their room and agreed on that.
template <class Search>
bool search_together(SearchRoom<Search>& room, Participant& self) {
    for (bool is_shared = false;; is_shared = true) {
        bool asks = false;
        self.attempt([&] {
            room.asked.clear();
            asks = room.search.ask(room.asked);
        });
        room.messages.run(room.asked, Butterfly::to_owners, {0, asks ? 1.0 : 0.0}, self);
        if (room.asked.flags()[1] == 0) return is_shared;
        if (!is_shared) room.messages.run(room.shared, Butterfly::to_owners, {}, self);
        self.attempt([&] { room.search.answer(room.shared, room.asked); });
        room.messages.run(room.asked, Butterfly::back, {}, self);
        self.compare([&] { room.search.learn(room.asked); });
    }
}

}  // namespace rrcb
