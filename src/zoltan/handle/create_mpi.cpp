#include "zoltan/handle/create_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "verbose_mpi.hpp"
#include "zoltan/handle/environment.hpp"
#include "zoltan/handle/replacement.hpp"
#include "zoltan/handle/roll_call_mpi.hpp"
#include "zoltan/handle/state.hpp"
#include "zoltan/real/message.hpp"
#include "zoltan/real/real_zoltan.hpp"

#include <memory>
#include <new>
#include <utility>

namespace rrcb::zoltan {

namespace {

/// Numbers of one rank in the vote on a new handle, which are reduced by their maximum.
struct Ballot {
    int failing_rank_from_last = 0;  ///< number of ranks minus lowest failing rank
    int leaves_all_to_zoltan = 0;
    int asks_for_replacement = 0;
    int does_not_ask = 0;
    int is_verbose = 0;
};

/// Buffers of nonblocking calls. MPI may write to them as long as the calls are pending.
struct Exchange {
    MPI_Comm duplicate = MPI_COMM_NULL;
    Ballot ballot;
};

/// Buffers of this thread, for one exchange at a time. They are replaced if calls stay pending.
thread_local Exchange first_exchange;
thread_local Exchange* exchange = &first_exchange;

void leave_pending() {
    auto* unused = new (std::nothrow) Exchange;
    if (unused != nullptr) exchange = unused;
}

/// Reduces the ballots of all ranks. Uses the duplicate, so that calls of the program cannot
/// interfere. Returns false if some ranks do not take part.
bool vote_on_environment(bool asks, RollCall& roll_call, Participant& self) {
    const int from_last = self.failed() ? mpi::size_of(self.comm) - mpi::rank_of(self.comm) : 0;
    exchange->ballot = {from_last, real_zoltan()->serves_rrcb ? 0 : 1, asks ? 1 : 0, asks ? 0 : 1,
                        is_verbosity_asked() ? 1 : 0};
    static_assert(sizeof(Ballot) == 5 * sizeof(int));
    const bool has_duplicate = exchange->duplicate != MPI_COMM_NULL;
    MPI_Request request = MPI_REQUEST_NULL;
    const int code = MPI_Iallreduce(MPI_IN_PLACE, &exchange->ballot, 5, MPI_INT, MPI_MAX,
                                    has_duplicate ? exchange->duplicate : self.comm, &request);
    // Even if the call has failed, its request may be pending.
    const bool are_all_here = roll_call.complete(request, self);
    if (are_all_here) mpi::check(code, "MPI_Iallreduce");
    return are_all_here;
}

bool is_congruent(const Communicator& one, const Communicator& other) {
    int result = MPI_UNEQUAL;
    mpi::check(MPI_Comm_compare(one.get(), other.get(), &result), "MPI_Comm_compare");
    return result == MPI_CONGRUENT;
}

/// Resources of a new handle. They are made before the ranks agree that all of them have succeeded.
struct Draft {
    MPI_Comm duplicate = MPI_COMM_NULL;  ///< owned here until the state takes it
    State state;                         ///< owned here until the table takes it
    bool asks_for_replacement = false;
};

/// Makes a draft. All ranks duplicate the communicator, even if one of them has failed. Returns
/// false if some ranks do not take part.
bool make(Draft& draft, const Zoltan_Struct* zz, MPI_Comm user, RollCall& roll_call,
          Participant& self) {
    *exchange = {};
    MPI_Request request = MPI_REQUEST_NULL;
    self.check(MPI_Comm_idup(user, &exchange->duplicate, &request), "MPI_Comm_idup");
    if (!roll_call.complete(request, self)) return false;
    draft.duplicate = exchange->duplicate;
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
    return true;
}

/// Frees the communicator. Collective.
void discard(Draft& draft, const Zoltan_Struct* zz) {
    remove_state(zz);
    draft.state.communicator.reset();
    if (draft.duplicate != MPI_COMM_NULL) MPI_Comm_free(&draft.duplicate);
}

}  // namespace

bool create_state(const Zoltan_Struct* zz, MPI_Comm user) {
    RollCall roll_call(user);
    Draft draft;
    Participant self{user};
    try {
        if (!make(draft, zz, user, roll_call, self) ||
            !vote_on_environment(draft.asks_for_replacement, roll_call, self)) {
            leave_pending();
            return false;
        }
        const Ballot& ballot = exchange->ballot;
        if (ballot.failing_rank_from_last > 0)
            fail_together(mpi::size_of(user) - ballot.failing_rank_from_last, self);
        if (ballot.leaves_all_to_zoltan != 0) {
            discard(draft, zz);
            return true;
        }
        State& state = *find_state(zz);
        state.is_verbose = ballot.is_verbose != 0;
        if (ballot.asks_for_replacement != 0) replace_rcb(state);
        if (ballot.asks_for_replacement == ballot.does_not_ask)
            warn_once(state.communicator->rank(), "Zoltan_Create",
                      "RRCB_REPLACE=RCB is in the environment of some ranks only; it holds on all");
        return true;
    } catch (...) {
        discard(draft, zz);
        throw;
    }
}

void copy_state(const Zoltan_Struct* to, const Zoltan_Struct* from) {
    const State* source = find_state(from);
    if (source == nullptr || to == from) return;
    // Zoltan_Copy makes the new handle by Zoltan_Create. If Zoltan is a shared library, that call
    // has passed through the plug-in, and the copy has a state already.
    State* copy = find_state(to);
    const bool fits = copy != nullptr && is_congruent(*copy->communicator, *source->communicator);
    if (!fits) {
        remove_state(to);
        if (!create_state(to, source->communicator->get()))
            throw Error(ErrorCode::mpi, "some ranks do not answer");
    }
    Participant self{source->communicator->get()};
    self.attempt([&] { copy_contents(*find_state(to), *source); });
    agree(self);
}

}  // namespace rrcb::zoltan
