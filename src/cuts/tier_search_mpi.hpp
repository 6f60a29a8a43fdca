#pragma once

#include "collective/butterfly_mpi.hpp"
#include "collective/communicator.hpp"

#include <utility>

namespace rrcb {

/// What a rank needs to take part in a search for cuts: that of a class derived from TierSearch,
/// whose ask(asked) asks for what it lacks, and returns whether it does.
template <class Search>
struct SearchBuffers {
    /// Throws Error where the rank lacks a cut that it owns.
    SearchBuffers(Search made, MPI_Comm comm)
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
/// time that some rank asks, and one to end. All ranks have made their buffers and agreed on that.
template <class Search>
bool search_together(SearchBuffers<Search>& buffers, Participant& self) {
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
