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

struct Place {
    std::atomic<const Zoltan_Struct*> zz = nullptr;  ///< null if the place is free for another
                                                     ///< handle
    State* state = nullptr;                          ///< used by the thread of the handle only
};

/// Places for handles. They are never freed, so that look-ups need no lock; with a lock they might
/// have to wait for the creation of another handle.
struct Block {
    std::array<Place, 4> places{};
    std::atomic<Block*> next = nullptr;
};

constexpr int num_bits = 9;

/// Lists of places, selected by a hash of the handle. They are not destroyed at exit, because
/// handles that outlive MPI must not free their communicators.
constinit std::array<Block, 1 << num_bits> first_blocks{};
constinit std::mutex adding;
constinit std::atomic<bool> any_made = false;

Block& first_block_for(const Zoltan_Struct* zz) {
    const std::uint64_t mixed = std::bit_cast<std::uintptr_t>(zz) * 0x9e3779b97f4a7c15U;
    return first_blocks[mixed >> (64 - num_bits)];
}

/// Returns the place of a handle, or, for null, a free place. Returns null if there is none.
Place* find_place(Block& first, const Zoltan_Struct* zz) {
    for (Block* block = &first; block != nullptr; block = block->next.load())
        for (Place& place : block->places)
            if (place.zz.load() == zz) return &place;
    return nullptr;
}

/// Takes a free place for a handle that has none. Throws std::bad_alloc.
Place& take_place(const Zoltan_Struct* zz) {
    Block& first = first_block_for(zz);
    const std::scoped_lock lock(adding);
    Place* place = find_place(first, nullptr);
    if (place == nullptr) {
        auto* const added = new Block;
        added->next = first.next.load();
        first.next = added;
        place = added->places.data();
    }
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
    const Place* place = find_place(first_block_for(zz), zz);
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
    Place* place = find_place(first_block_for(zz), zz);
    if (place == nullptr) return;
    const std::unique_ptr<State> removed(std::exchange(place->state, nullptr));
    place->zz = nullptr;
}

bool any_handle_made() {
    return any_made;
}

}  // namespace rrcb::zoltan
