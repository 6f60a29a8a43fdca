#include "collective/agreement_mpi.hpp"

#include "collective/communicator.hpp"
#include "collective/meeting_mpi.hpp"
#include "collective/merge_tree.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace rrcb {

namespace {

constexpr std::size_t most_shared = 12;

/// Returns the rank of this failure in the order of reporting; the smallest number is reported.
/// Failures that no other failure can have caused come first, then lower ranks.
std::uint64_t order_of(const Participant& self) {
    const auto num_ranks = static_cast<std::uint64_t>(mpi::size_of(self.comm));
    if (!self.failed()) return 2 * num_ranks;
    const auto rank = static_cast<std::uint64_t>(mpi::rank_of(self.comm));
    return self.failure.may_follow ? num_ranks + rank : rank;
}

/// Least value of an argument, and the complement of its greatest value.
using Ends = std::array<std::uint64_t, 2>;
constexpr Ends not_needed{std::numeric_limits<std::uint64_t>::max(),
                          std::numeric_limits<std::uint64_t>::max()};

Ends ends_of(const Shared& argument) {
    return argument.is_needed ? Ends{argument.value, ~argument.value} : not_needed;
}

/// order_of() this rank's failure, followed by the ends of each argument.
using Words = std::array<std::uint64_t, 1 + 2 * most_shared>;

/// Takes the minimum of each value over the ranks. Collective.
void find_smallest(std::span<std::uint64_t> values, MPI_Comm comm) {
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()),
                             MPI_UINT64_T, MPI_MIN, comm),
               "MPI_Allreduce");
}

/// As find_smallest(), in the meeting of a call. The first value is order_of() this rank's failure;
/// it is computed again after the messages, which may fail themselves. Collective.
void meet(std::span<std::uint64_t> values, Participant& self) {
    const int rank = mpi::rank_of(self.comm);
    const MergeTree tree{mpi::size_of(self.comm)};
    tree.for_each_child(rank, [&](int child) {
        Words theirs;
        theirs.fill(not_needed[0]);
        receive(std::as_writable_bytes(std::span(theirs).first(values.size())), child,
                mpi::agreement_tag, self);
        for (std::size_t k = 0; k < values.size(); ++k) values[k] = std::min(values[k], theirs[k]);
    });
    values[0] = std::min(values[0], order_of(self));
    if (rank != root) send(std::as_bytes(values), tree.parent(rank), mpi::agreement_tag, self);
    broadcast_and_meet(std::as_writable_bytes(values), self);
}

}  // namespace

Shared weights_given(const Points& points) {
    return {"whether points have weights", points.weights.empty() ? 0u : 1u, points.count > 0,
            "give one for each point on every rank that has points, or none"};
}

std::string difference(std::string_view name, std::string_view fix, int rank, int other) {
    return std::string(name) + " differs between rank " + std::to_string(std::min(rank, other)) +
           " and rank " + std::to_string(std::max(rank, other)) + "; " + std::string(fix);
}

void agree(Participant& self, std::initializer_list<Shared> arguments) {
    std::array<Shared, most_shared> compared;
    std::ranges::copy(arguments, compared.begin());
    agree(self, std::span(compared).first(arguments.size()));
}

void agree(Participant& self, std::span<Shared> arguments) {
    const std::size_t differing = find_difference(self, arguments);
    if (differing < arguments.size()) refuse(arguments[differing], self);
}

std::size_t find_difference(Participant& self, std::span<Shared> arguments) {
    const auto num_ranks = static_cast<std::uint64_t>(mpi::size_of(self.comm));
    Words smallest;
    smallest[0] = order_of(self);
    std::size_t length = 1;
    for (const Shared& argument : arguments)
        for (const std::uint64_t end : ends_of(argument)) smallest[length++] = end;
    const std::span<std::uint64_t> values = std::span(smallest).first(length);
    if (self.is_meeting()) {
        meet(values, self);
    } else {
        find_smallest(values, self.comm);
    }
    if (smallest[0] < 2 * num_ranks) fail_together(static_cast<int>(smallest[0] % num_ranks), self);
    for (std::size_t k = 0; k < arguments.size(); ++k) {
        const Ends ends{smallest[1 + 2 * k], smallest[2 + 2 * k]};
        if (ends != not_needed && ends[0] != ~ends[1]) return k;
        if (!arguments[k].is_needed) arguments[k].value = ends == not_needed ? 0 : ends[0];
    }
    return arguments.size();
}

void refuse(const Shared& argument, Participant& self) {
    // Names the lowest ranks with the least and the greatest value.
    const Ends here = ends_of(argument);
    Ends ends = here;
    find_smallest(ends, self.comm);
    const auto rank = static_cast<std::uint64_t>(mpi::rank_of(self.comm));
    Ends ranks{here[0] == ends[0] ? rank : not_needed[0],
               here[1] == ends[1] ? rank : not_needed[1]};
    find_smallest(ranks, self.comm);
    throw_error(ErrorCode::invalid_argument, [&] {
        return difference(argument.name, argument.fix, static_cast<int>(ranks[0]),
                          static_cast<int>(ranks[1]));
    });
}

void fail_together(int failing_rank, Participant& self) {
    if (failing_rank == no_rank) return;
    if (failing_rank == some_rank) return agree(self);
    Failure theirs = self.failure;
    mpi::check(MPI_Bcast(&theirs, sizeof theirs, MPI_BYTE, failing_rank, self.comm), "MPI_Bcast");
    throw_error(theirs.code,
                [&] { return "rank " + std::to_string(failing_rank) + ": " + theirs.text.data(); });
}

}  // namespace rrcb
