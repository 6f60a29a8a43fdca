#include "zoltan/handle/state.hpp"

#include "collective/communicator.hpp"

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <utility>

namespace rrcb::zoltan {

namespace {

constexpr std::uint64_t first_version = 1;

struct Table {
    std::shared_mutex mutex;
    std::map<const Zoltan_Struct*, State> states;
    std::atomic<std::uint64_t> version = first_version;  ///< of the set of handles
};

Table& table() {
    // Never destroyed: handles that outlive MPI must not free their communicators at exit.
    static auto& only = *new Table;
    return only;
}

/// Handle that a thread looked up last. Without it, point look-ups would wait for the lock.
struct LastFound {
    const Zoltan_Struct* zz = nullptr;
    State* state = nullptr;
    std::uint64_t version = 0;
};

}  // namespace

Communicator::Communicator(MPI_Comm duplicate)
    : rank_(mpi::rank_of(duplicate)),
      size_(mpi::size_of(duplicate)),
      per_rank_(std::make_unique_for_overwrite<int[]>(size_)) {
    mpi::check(MPI_Comm_set_errhandler(duplicate, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
    comm_ = duplicate;
}

Communicator::~Communicator() {
    MPI_Comm_free(&comm_);
}

State* find_state(const Zoltan_Struct* zz) {
    thread_local LastFound last;
    Table& all = table();
    if (last.zz == zz && last.version == all.version.load(std::memory_order_acquire))
        return last.state;
    const std::shared_lock lock(all.mutex);
    const auto found = all.states.find(zz);
    last = {zz, found == all.states.end() ? nullptr : &found->second, all.version.load()};
    return last.state;
}

State& add_state(const Zoltan_Struct* zz, State&& state) {
    Table& all = table();
    State* place = nullptr;
    {
        const std::unique_lock lock(all.mutex);
        place = &all.states[zz];
        ++all.version;
    }
    // After the lock is released: other ranks take part in freeing the communicator that was there.
    *place = std::move(state);
    return *place;
}

void copy_contents(State& to, const State& from) {
    State copy;
    static_cast<Settings&>(copy) = from;
    if (from.last) copy.last = from.last->copy();
    copy.communicator = std::move(to.communicator);
    to = std::move(copy);
}

void remove_state(const Zoltan_Struct* zz) {
    Table& all = table();
    // Freed after the lock is released: other ranks take part in freeing it.
    decltype(all.states)::node_type removed;
    const std::unique_lock lock(all.mutex);
    removed = all.states.extract(zz);
    if (!removed.empty()) ++all.version;
}

bool any_handle_made() {
    return table().version.load() != first_version;
}

}  // namespace rrcb::zoltan
