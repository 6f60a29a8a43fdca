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

/// A place for a handle. It is never freed, so look-ups need no lock, for which creating a handle
/// could wait without end.
struct Place {
    std::atomic<const Zoltan_Struct*> zz;  ///< null: free for another handle
    State* state;                          ///< touched by the thread of the handle only
    Place* next;
};

constexpr int num_bits = 9;

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
Place* find_place(Place* place, const Zoltan_Struct* zz) {
    while (place != nullptr && place->zz.load() != zz) place = place->next;
    return place;
}

Place* place_of(const Zoltan_Struct* zz) {
    return find_place(first_place_for(zz), zz);
}

/// Takes a place for a handle without one. Throws std::bad_alloc.
Place& take_place(const Zoltan_Struct* zz) {
    std::atomic<Place*>& first = first_place_for(zz);
    const std::scoped_lock lock(adding);
    Place* place = find_place(first, nullptr);
    if (place == nullptr) first = place = new Place{nullptr, nullptr, first};
    place->zz = zz;
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
    const Place* place = place_of(zz);
    return place == nullptr ? nullptr : place->state;
}

void add_state(const Zoltan_Struct* zz, State&& state) {
    remove_state(zz);
    take_place(zz).state = new State(std::move(state));
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
    Place* place = place_of(zz);
    if (place == nullptr) return;
    const std::unique_ptr<State> removed(std::exchange(place->state, nullptr));
    place->zz = nullptr;
}

bool any_handle_made() {
    return any_made;
}

}  // namespace rrcb::zoltan
