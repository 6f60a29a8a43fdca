#pragma once

#include "collective/butterfly_mpi.hpp"
#include "collective/communicator.hpp"
#include "lists/tier_search.hpp"

#include <utility>

namespace rrcb {

/// Buffers of a rank for a search by a class derived from TierSearch. Its ask(asked) asks for
/// missing cuts, and returns whether there are any.
template <class Search>
struct SearchBuffers {
    /// Throws Error if the rank lacks a cut of its own.
    SearchBuffers(Search made, MPI_Comm comm)
        : search(std::move(made)),
          shared(mpi::rank_of(comm), mpi::size_of(comm), Search::join_cuts),
          asked(mpi::rank_of(comm), mpi::size_of(comm), Search::join_questions) {
        search.share(shared);
    }

    Search search;
    Butterfly shared;
    Butterfly asked;
    ButterflyMessages messages;
};

/// Asks until no rank lacks cuts. Returns whether any rank did.
///
/// Collective, after all ranks have agreed that their buffers are made. One pass through the ranks
/// if none asks; otherwise one to share cuts, two for each round of questions, and one to end.
template <class Search>
bool search_together(SearchBuffers<Search>& buffers, Participant& self) {
    // After a pass all ranks know the same flags, and therefore agree on the next messages.
    for (bool is_shared = false;; is_shared = true) {
        bool asks = false;
        self.attempt([&] {
            buffers.asked.clear();
            asks = buffers.search.ask(buffers.asked);
        });
        buffers.messages.run(buffers.asked, Butterfly::to_owners, {0, asks ? 1.0 : 0.0}, self);
        if (buffers.asked.flags()[1] == 0) return is_shared;
        if (!is_shared) buffers.messages.run(buffers.shared, Butterfly::to_owners, {}, self);
        self.attempt([&] { buffers.search.answer(buffers.shared, buffers.asked); });
        buffers.messages.run(buffers.asked, Butterfly::back, {}, self);
        self.compare([&] { buffers.search.learn(buffers.asked); });
    }
}

}  // namespace rrcb
