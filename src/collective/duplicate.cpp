#include "collective/duplicate.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/attribute_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/spread_failure_mpi.hpp"

#include <rrcb/detail/mix.hpp>
#include <rrcb/error.hpp>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <utility>

namespace rrcb::mpi {

namespace {

/// The library's duplicate of a communicator, which frees it. If the use of the duplicate has ended
/// after a failure, messages on it may be pending; then neither it nor their memory is freed.
struct Duplicate {
    std::shared_ptr<CallLog> log = std::make_shared<CallLog>();

    ~Duplicate() {
        static std::shared_ptr<CallLog> ended;
        if (log->end != CallLog::End::none) {
            log->ended_before = std::exchange(ended, log);
            return;
        }
        MPI_Comm comm = std::exchange(log->comm, MPI_COMM_NULL);
        if (comm != MPI_COMM_NULL) MPI_Comm_free(&comm);
    }
};

/// Returns a random number that identifies this process.
std::uint64_t number_of_process() {
    static const std::uint64_t number = [] {
        std::random_device random;
        return std::uint64_t{random()} << 32 | random();
    }();
    return number;
}

/// Returns a number that identifies the processes of `self` and their order. Collective.
std::uint64_t make_group(Participant& self) {
    std::uint64_t here = 0;
    self.attempt([&] {
        here = detail::mix(number_of_process() ^
                           detail::mix(static_cast<std::uint64_t>(rank_of(self.comm)) + 1));
    });
    std::uint64_t all = 0;
    self.check(MPI_Allreduce(&here, &all, 1, MPI_UINT64_T, MPI_BXOR, self.comm), "MPI_Allreduce");
    return std::max(all, std::uint64_t{1});
}

void refuse_two_groups(MPI_Comm user) {
    int has_two = 0;
    check(MPI_Comm_test_inter(user, &has_two), "MPI_Comm_test_inter");
    if (has_two != 0)
        throw Error(ErrorCode::invalid_argument,
                    "an intercommunicator has two groups; merge them by MPI_Intercomm_merge");
}

/// Returns the duplicate kept with `user`, or null. If its use has ended, because ranks made
/// different calls or failed, it is detached to make room for another one, and `old` gets its log.
Duplicate* kept_with(MPI_Comm user, std::shared_ptr<CallLog>& old) {
    Duplicate* found = Attribute<Duplicate>::find(user);
    if (found == nullptr || found->log->end == CallLog::End::none) return found;
    old = found->log;
    Attribute<Duplicate>::forget(user);
    return nullptr;
}

/// Makes the duplicate and keeps it with `user`. If there was an `old` one, which all ranks then
/// have, receives its remaining messages. Collective.
Duplicate& make(MPI_Comm user, CallLog* old) {
    refuse_two_groups(user);
    MPI_Comm comm = MPI_COMM_NULL;
    Duplicate* kept = nullptr;
    Participant self{user};
    self.check(MPI_Comm_dup(user, &comm), "MPI_Comm_dup");
    const std::uint64_t group = old != nullptr ? old->group : make_group(self);
    self.attempt([&] {
        check(MPI_Comm_set_errhandler(comm, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
        kept = Attribute<Duplicate>::keep(std::make_unique<Duplicate>(), user);
        kept->log->comm = comm;
        kept->log->group = group;
    });
    try {
        agree(self);
    } catch (...) {
        if (!self.failed()) {
            Attribute<Duplicate>::forget(user);
        } else if (comm != MPI_COMM_NULL) {
            MPI_Comm_free(&comm);
        }
        throw;
    }
    if (old != nullptr) drain(*old, comm);
    return *kept;
}

}  // namespace

bool is_running() {
    int has_begun = 0;
    int has_ended = 0;
    MPI_Initialized(&has_begun);
    MPI_Finalized(&has_ended);
    return has_begun != 0 && has_ended == 0;
}

void check_is_running() {
    if (!is_running())
        throw Error(ErrorCode::invalid_argument,
                    "MPI is not running; call after MPI_Init and before MPI_Finalize");
}

const MPI_Comm* find_duplicate(MPI_Comm user) {
    const Duplicate* found = Attribute<Duplicate>::find(user);
    return found != nullptr && found->log->end == CallLog::End::none ? &found->log->comm : nullptr;
}

Participant enter(MPI_Comm user, CallName call) {
    check_is_running();
    if (user == MPI_COMM_NULL)
        throw Error(ErrorCode::invalid_argument,
                    "MPI_COMM_NULL has no ranks; give a communicator with this rank in it");
    std::shared_ptr<CallLog> old;
    Duplicate* found = kept_with(user, old);
    const Duplicate& kept = found != nullptr ? *found : make(user, old.get());
    kept.log->begin(call);
    return {kept.log->comm, kept.log};
}

void require_group(std::uint64_t group, const char* made, const Participant& self) {
    const std::uint64_t here = self.group();
    if (group == 0 || here == 0 || group == here) return;
    throw Error(ErrorCode::invalid_argument,
                std::string(made) +
                    " belongs to other ranks than this communicator; give the communicator that "
                    "it was made with");
}

}  // namespace rrcb::mpi
