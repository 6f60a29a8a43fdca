#include "zoltan/handle/create_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "zoltan/handle/environment.hpp"
#include "zoltan/handle/replacement.hpp"
#include "zoltan/handle/state.hpp"
#include "zoltan/real/message.hpp"
#include "zoltan/real/real_zoltan.hpp"

#include <atomic>
#include <memory>
#include <utility>

namespace rrcb::zoltan {

namespace {

/// Numbers of one rank in the vote on a new handle, reduced by maximum.
struct Ballot {
    int failing_rank_from_last = 0;  ///< ranks - lowest failing rank
    int leaves_all_to_zoltan = 0;
    int asks_for_replacement = 0;
    int does_not_ask = 0;
};

Ballot vote_on_environment(bool asks, const Participant& self) {
    const int num_ranks = mpi::size_of(self.comm);
    Ballot ballot{self.failed() ? num_ranks - mpi::rank_of(self.comm) : 0,
                  real_zoltan()->serves_rrcb ? 0 : 1, asks ? 1 : 0, asks ? 0 : 1};
    static_assert(sizeof ballot == 4 * sizeof(int));
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, &ballot, 4, MPI_INT, MPI_MAX, self.comm),
               "MPI_Allreduce");
    if (ballot.failing_rank_from_last > 0)
        fail_together(num_ranks - ballot.failing_rank_from_last, self);
    return ballot;
}

void warn_once_of_difference(int rank) {
    static std::atomic<bool> warned = false;
    if (rank != 0 || warned.exchange(true)) return;
    print_warning(rank, "Zoltan_Create",
                  "RRCB_REPLACE=RCB is in the environment of some ranks only; it holds on all");
}

bool is_congruent(const Communicator& one, const Communicator& other) {
    int result = MPI_UNEQUAL;
    mpi::check(MPI_Comm_compare(one.get(), other.get(), &result), "MPI_Comm_compare");
    return result == MPI_CONGRUENT;
}

/// Belongings of a new handle, made before the ranks agree that all of them have it.
struct Draft {
    MPI_Comm duplicate = MPI_COMM_NULL;  ///< until the state has it
    State state;                         ///< until the table has it
    bool asks_for_replacement = false;
};

/// Makes them. All ranks duplicate the communicator, whatever fails on one of them.
void make(Draft& draft, const Zoltan_Struct* zz, MPI_Comm user, Participant& self) {
    self.check(MPI_Comm_dup(user, &draft.duplicate), "MPI_Comm_dup");
    self.attempt([&] {
        State& state = draft.state;
        state.communicator = std::make_unique<Communicator>(draft.duplicate);
        draft.duplicate = MPI_COMM_NULL;
        state.parameters = initial_parameters();
        state.inside_hier = is_inside_hier();
        read_environment(state);
        draft.asks_for_replacement = is_replacement_asked();
        add_state(zz, std::move(state));
    });
}

/// Frees the communicator together with the other ranks.
void discard(Draft& draft, const Zoltan_Struct* zz) {
    remove_state(zz);
    draft.state.communicator.reset();
    if (draft.duplicate != MPI_COMM_NULL) MPI_Comm_free(&draft.duplicate);
}

}  // namespace

void create_state(const Zoltan_Struct* zz, MPI_Comm user) {
    Draft draft;
    Participant self{user};
    make(draft, zz, user, self);
    try {
        const Ballot ballot = vote_on_environment(draft.asks_for_replacement, self);
        if (ballot.leaves_all_to_zoltan != 0) return discard(draft, zz);
        State& state = *find_state(zz);
        if (ballot.asks_for_replacement != 0) replace_rcb(state);
        if (ballot.asks_for_replacement == ballot.does_not_ask)
            warn_once_of_difference(state.communicator->rank());
    } catch (...) {
        discard(draft, zz);
        throw;
    }
}

void copy_state(const Zoltan_Struct* to, const Zoltan_Struct* from) {
    const State* source = find_state(from);
    if (source == nullptr || to == from) return;
    // Zoltan_Copy makes the new handle with Zoltan_Create, which has come through here where Zoltan
    // is a shared library.
    State* copy = find_state(to);
    const bool fits = copy != nullptr && is_congruent(*copy->communicator, *source->communicator);
    if (!fits) {
        remove_state(to);
        create_state(to, source->communicator->get());
    }
    Participant self{source->communicator->get()};
    self.attempt([&] { copy_contents(*find_state(to), *source); });
    agree(self);
}

}  // namespace rrcb::zoltan
