#include "collective/agreement_mpi.hpp"

#include "collective/communicator.hpp"

#include <array>
#include <new>
#include <string>

namespace rrcb {

namespace {

constexpr std::size_t most_shared = 11;

/// Throws the same on all ranks, without the text on a rank that has no memory for it.
template <class MakeText>
[[noreturn]] void throw_alike(ErrorCode code, MakeText&& make_text) {
    try {
        throw Error(code, make_text());
    } catch (const std::bad_alloc&) {
        throw Error(code);
    }
}

/// Returns the order in which failures are reported: first those that follow from no other.
std::uint64_t order_of(const Participant& self, std::uint64_t num_ranks) {
    if (!self.failed()) return 2 * num_ranks;
    const auto rank = static_cast<std::uint64_t>(mpi::rank_of(self.comm));
    return self.failure.may_follow ? num_ranks + rank : rank;
}

}  // namespace

void agree(const Participant& self) {
    agree(self, {});
}

void agree(const Participant& self, std::initializer_list<Shared> arguments) {
    const std::size_t differing = find_difference(self, {arguments.begin(), arguments.size()});
    if (differing < arguments.size()) refuse(arguments.begin()[differing], self);
}

std::size_t find_difference(const Participant& self, std::span<const Shared> arguments) {
    const auto num_ranks = static_cast<std::uint64_t>(mpi::size_of(self.comm));
    // The minimum of the complement gives the maximum.
    std::array<std::uint64_t, 1 + 2 * most_shared> smallest;
    smallest[0] = order_of(self, num_ranks);
    std::size_t length = 1;
    for (const Shared& argument : arguments) {
        smallest[length++] = argument.value;
        smallest[length++] = ~argument.value;
    }
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, smallest.data(), static_cast<int>(length), MPI_UINT64_T,
                             MPI_MIN, self.comm),
               "MPI_Allreduce");
    if (smallest[0] < 2 * num_ranks) fail_together(static_cast<int>(smallest[0] % num_ranks), self);
    std::size_t first = 0;
    while (first < arguments.size() && smallest[1 + 2 * first] == ~smallest[2 + 2 * first]) ++first;
    return first;
}

void refuse(const Shared& argument, const Participant& self) {
    // Names the lowest rank with another value than the root.
    const int num_ranks = mpi::size_of(self.comm);
    std::uint64_t of_root = argument.value;
    mpi::check(MPI_Bcast(&of_root, 1, MPI_UINT64_T, root, self.comm), "MPI_Bcast");
    int differing = argument.value != of_root ? mpi::rank_of(self.comm) : num_ranks;
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, &differing, 1, MPI_INT, MPI_MIN, self.comm),
               "MPI_Allreduce");
    throw_alike(ErrorCode::invalid_argument, [&] {
        return std::string(argument.name) + " differs between rank " + std::to_string(root) +
               " and rank " + std::to_string(differing) + "; give the same value on every rank";
    });
}

void fail_together(int failing_rank, const Participant& self) {
    if (failing_rank == no_rank) return;
    if (failing_rank == some_rank) return agree(self);
    Failure theirs = self.failure;
    mpi::check(MPI_Bcast(&theirs, sizeof theirs, MPI_BYTE, failing_rank, self.comm), "MPI_Bcast");
    throw_alike(theirs.code,
                [&] { return "rank " + std::to_string(failing_rank) + ": " + theirs.text.data(); });
}

}  // namespace rrcb
