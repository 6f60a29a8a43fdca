#include "zoltan/call/layout_mpi.hpp"

#include "collective/communicator.hpp"

#include <algorithm>
#include <array>

namespace rrcb::zoltan {

namespace {

constexpr double not_set = -1;

/// Returns the number of parts. If any rank sets NUM_LOCAL_PARTS, writes the number of each rank
/// into `local_parts`.
int count_parts(const Outcome& outcome, const State& state, std::span<int> local_parts) {
    const Communicator& comm = *state.communicator;
    if (!outcome.any_local_parts)
        return outcome.num_global_parts > 0 ? outcome.num_global_parts : comm.size();
    mpi::check(MPI_Allgather(&state.parameters.num_local_parts, 1, MPI_INT, local_parts.data(), 1,
                             MPI_INT, comm.get()),
               "MPI_Allgather");
    return num_parts_of(local_parts, outcome.num_global_parts);
}

/// Collects the sizes that this rank asks for, for the parts from `first_part` on.
void ask_for_sizes(const State& state, int first_here, int first_part, std::span<double> sizes) {
    std::ranges::fill(sizes, not_set);
    for (const PartSize& entry : state.part_sizes) {
        if (entry.weight != 0) continue;
        const int part = (entry.global ? 0 : first_here) + entry.part - first_part;
        if (part < 0 || part >= static_cast<int>(sizes.size())) continue;
        sizes[part] = static_cast<double>(entry.size);
    }
}

/// Determines the sizes of the parts, merged as in Zoltan: the largest size that any rank asks for;
/// 1 if no rank asks for one.
///
/// They are merged in pieces, for which every rank has memory.
void merge_part_sizes(int num_parts, const State& state, const Layout& layout,
                      std::vector<double>& merged, Participant& self) {
    self.attempt([&] { merged.resize(num_parts); });
    const int first_here = first_part_of(layout.map, state.communicator->rank());
    std::array<double, 4096> piece;
    for (int first_part = 0; first_part < num_parts; first_part += static_cast<int>(piece.size())) {
        const int count = std::min(num_parts - first_part, static_cast<int>(piece.size()));
        const std::span<double> sizes = std::span(piece).first(count);
        ask_for_sizes(state, first_here, first_part, sizes);
        mpi::check(MPI_Allreduce(MPI_IN_PLACE, sizes.data(), count, MPI_DOUBLE, MPI_MAX, self.comm),
                   "MPI_Allreduce");
        std::ranges::replace_if(
            sizes, [](double size) { return size < 0; }, 1.0);
        if (!self.failed()) std::ranges::copy(sizes, merged.begin() + first_part);
    }
}

}  // namespace

Layout make_layout(const Outcome& outcome, const State& state, Participant& self) {
    const std::span<int> local_parts = state.communicator->per_rank();
    const int num_parts = count_parts(outcome, state, local_parts);
    Layout layout;
    self.attempt([&] {
        layout.map = outcome.any_local_parts ? local_part_map(local_parts, num_parts)
                                             : even_part_map(num_parts, state.communicator->size());
    });
    // The size of a single part does not matter.
    if (outcome.any_part_sizes && num_parts > 1)
        merge_part_sizes(num_parts, state, layout, layout.part_sizes, self);
    return layout;
}

}  // namespace rrcb::zoltan
