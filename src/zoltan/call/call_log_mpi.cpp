#include "zoltan/call/call_log_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "zoltan/handle/replacement.hpp"

#include <rrcb/version.hpp>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <new>

namespace rrcb::zoltan {

namespace {

std::atomic<bool> any_answered = false;

/// Sums over the calls in which this process was rank 0.
struct Tally {
    std::int64_t calls = 0;
    double seconds = 0;
    std::int64_t objects = 0;  ///< only of calls with lists, which show how many moved
    std::int64_t moved = 0;
};

std::mutex tally_mutex;
Tally tally;

void print_tally() {
    std::printf("RRCB %s: %lld %s, %.4f s", version(), static_cast<long long>(tally.calls),
                tally.calls == 1 ? "call" : "calls", tally.seconds);
    if (tally.objects > 0) {
        std::printf(", %.2f %% of the objects moved to another rank",
                    100.0 * static_cast<double>(tally.moved) / static_cast<double>(tally.objects));
    }
    std::printf("\n");
}

/// Returns the number of objects in a list whose rank changes.
std::int64_t count_moved(const List& list, int rank) {
    std::int64_t moved = 0;
    for (int i = 0; i < list.count; ++i) moved += list.ranks[i] != rank ? 1 : 0;
    return moved;
}

void add_to_tally(const State& state, const Partition& result, double seconds) {
    const int rank = state.communicator->rank();
    const bool has_lists = state.parameters.return_lists != ReturnLists::none;
    const bool has_exports = result.exports.count >= 0;
    std::int64_t moved = count_moved(has_exports ? result.exports : result.imports, rank);
    const bool is_root = rank == root;
    MPI_Reduce(is_root ? MPI_IN_PLACE : &moved, is_root ? &moved : nullptr, 1, MPI_INT64_T, MPI_SUM,
               root, state.communicator->get());
    if (!is_root) return;
    const std::scoped_lock lock(tally_mutex);
    if (tally.calls == 0) std::atexit(print_tally);
    ++tally.calls;
    tally.seconds += seconds;
    if (!has_lists) return;
    tally.objects += result.summary->num_objects;
    tally.moved += moved;
}

void print_first_call(const State& state, const Summary& summary, double seconds) {
    static std::atomic<bool> is_printed = false;
    if (is_printed.exchange(true)) return;
    const std::string method = method_of(state);
    std::printf("RRCB %s answers LB_METHOD=%s: %lld objects on %d ranks in %d parts, ", version(),
                method.c_str(), static_cast<long long>(summary.num_objects),
                state.communicator->size(), summary.num_parts);
    if (summary.num_objects > 0) {
        std::printf("imbalance %.4f (%s), ", summary.imbalance,
                    summary.is_measured ? "measured" : "estimated");
    }
    std::printf("%.2f ms\n", 1e3 * seconds);
    std::fflush(stdout);
}

}  // namespace

void log_call(const State& state, const Partition& result, double seconds) noexcept try {
    if (!result.summary) return;
    any_answered = true;
    if (state.is_verbose) add_to_tally(state, result, seconds);
    const bool is_asked = state.is_verbose || state.parameters.debug_level >= 1;
    if (is_asked && state.communicator->rank() == root)
        print_first_call(state, *result.summary, seconds);
} catch (const std::bad_alloc&) {
    // Without memory only the line is lost.
}

bool any_call_answered() noexcept {
    return any_answered;
}

}  // namespace rrcb::zoltan
