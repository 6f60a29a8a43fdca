#include "layout_mpi.hpp"

#include "failure.hpp"
#include "mpi/communicator.hpp"

#include <algorithm>

namespace rrcb::zoltan {

namespace {

PartMap make_part_map(const Agreement& agreement, const State& state) {
    const Communicator& comm = *state.communicator;
    if (!agreement.any_local_parts) {
        const bool set = agreement.num_global_parts > 0;
        return even_part_map(set ? agreement.num_global_parts : comm.size(), comm.size());
    }
    std::vector<int> local_parts(static_cast<std::size_t>(comm.size()));
    mpi::check(MPI_Allgather(&state.parameters.num_local_parts, 1, MPI_INT, local_parts.data(), 1,
                             MPI_INT, comm.get()),
               "MPI_Allgather");
    return local_part_map(local_parts, agreement.num_global_parts);
}

/// As Zoltan merges them: the largest that any rank asks for, 1 where none does.
std::vector<double> merge_part_sizes(const PartMap& map, const State& state) {
    constexpr double not_set = -1;
    std::vector<double> sizes(static_cast<std::size_t>(map.num_parts()), not_set);
    const int first = first_part_of(map, state.communicator->rank());
    for (const PartSize& entry : state.part_sizes) {
        const int part = entry.global ? entry.part : first + entry.part;
        if (part < 0 || part >= map.num_parts()) continue;
        sizes[static_cast<std::size_t>(part)] = static_cast<double>(entry.size);
    }
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, sizes.data(), map.num_parts(), MPI_DOUBLE, MPI_MAX,
                             state.communicator->get()),
               "MPI_Allreduce");
    std::ranges::replace_if(
        sizes, [](double size) { return size < 0; }, 1.0);
    return sizes;
}

}  // namespace

Layout make_layout(const Agreement& agreement, const State& state) {
    Layout layout;
    layout.map = make_part_map(agreement, state);
    if (agreement.any_part_sizes) layout.part_sizes = merge_part_sizes(layout.map, state);
    return layout;
}

}  // namespace rrcb::zoltan
