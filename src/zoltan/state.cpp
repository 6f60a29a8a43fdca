#include "state.hpp"

#include "mpi/communicator.hpp"

#include <map>
#include <utility>

namespace rrcb::zoltan {

namespace {

std::map<const Zoltan_Struct*, State>& table() {
    // Never destroyed: handles that outlive MPI must not free their communicators at exit.
    static auto& states = *new std::map<const Zoltan_Struct*, State>;
    return states;
}

}  // namespace

Communicator::Communicator(MPI_Comm duplicate)
    : rank_(mpi::rank_of(duplicate)),
      size_(mpi::size_of(duplicate)),
      per_rank_(static_cast<std::size_t>(size_)) {
    mpi::check(MPI_Comm_set_errhandler(duplicate, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
    comm_ = duplicate;
}

Communicator::~Communicator() {
    MPI_Comm_free(&comm_);
}

State* find_state(const Zoltan_Struct* zz) {
    const auto found = table().find(zz);
    return found == table().end() ? nullptr : &found->second;
}

State& add_state(const Zoltan_Struct* zz, std::shared_ptr<Communicator> communicator) {
    State& state = table()[zz];
    state = State{};
    state.communicator = std::move(communicator);
    return state;
}

void copy_state(const Zoltan_Struct* to, const Zoltan_Struct* from) {
    const State* source = find_state(from);
    if (source == nullptr || to == from) return;
    State& copy = add_state(to, source->communicator);
    copy.parameters = source->parameters;
    copy.part_sizes = source->part_sizes;
    copy.kept = source->kept;
    copy.rest = source->rest;
    copy.axes_changed = source->axes_changed;
    copy.deserialized = source->deserialized;
}

void remove_state(const Zoltan_Struct* zz) {
    table().erase(zz);
}

}  // namespace rrcb::zoltan
