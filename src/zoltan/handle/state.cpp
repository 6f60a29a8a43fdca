#include "zoltan/handle/state.hpp"

#include "collective/communicator.hpp"

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <mutex>
#include <utility>

namespace rrcb::zoltan {

namespace {

/// Place for a handle. Places are never freed, so look-ups need no lock, for which creating a
/// handle could wait without end.
struct Place {
    std::atomic<const Zoltan_Struct*> zz = nullptr;  ///< null: free for another handle
    std::unique_ptr<State> state{};                  ///< touched by the thread of the handle only
    Place* next = nullptr;
};

constexpr int num_bits = 10;

/// Lists of places, by a hash of the handle. At exit they stay: handles that outlive MPI must not
/// free their communicators.
constinit std::array<std::atomic<Place*>, 1 << num_bits> first_places{};
constinit std::mutex adding;
constinit std::atomic<bool> any_made = false;

std::atomic<Place*>& first_place_for(const Zoltan_Struct* zz) {
    const std::uint64_t mixed = std::bit_cast<std::uintptr_t>(zz) * 0x9e3779b97f4a7c15U;
    return first_places[mixed >> (64 - num_bits)];
}

/// Returns the place of a handle, or a free one for null; null if there is none.
Place* find_place(const std::atomic<Place*>& first, const Zoltan_Struct* zz) {
    Place* place = first.load(std::memory_order_acquire);
    while (place != nullptr && place->zz.load(std::memory_order_acquire) != zz) place = place->next;
    return place;
}

/// Takes a place for a handle that has none. Throws std::bad_alloc.
Place& take_place(const Zoltan_Struct* zz) {
    std::atomic<Place*>& first = first_place_for(zz);
    const std::scoped_lock lock(adding);
    Place* place = find_place(first, nullptr);
    if (place == nullptr) {
        place = new Place{.next = first.load()};
        first.store(place, std::memory_order_release);
    }
    place->zz.store(zz, std::memory_order_release);
    return *place;
}

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
    const Place* place = find_place(first_place_for(zz), zz);
    return place == nullptr ? nullptr : place->state.get();
}

void add_state(const Zoltan_Struct* zz, State&& state) {
    remove_state(zz);
    take_place(zz).state = std::make_unique<State>(std::move(state));
    any_made = true;
}

void copy_contents(State& to, const State& from) {
    State copy;
    static_cast<Settings&>(copy) = from;
    if (from.last) copy.last = from.last->copy();
    copy.communicator = std::move(to.communicator);
    to = std::move(copy);
}

void remove_state(const Zoltan_Struct* zz) {
    Place* place = find_place(first_place_for(zz), zz);
    if (place == nullptr) return;
    const std::unique_ptr<State> removed = std::move(place->state);
    place->zz.store(nullptr, std::memory_order_release);
}

bool any_handle_made() {
    return any_made;
}

}  // namespace rrcb::zoltan
