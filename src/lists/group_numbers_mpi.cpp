#include "lists/group_numbers_mpi.hpp"

#include "collective/communicator.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace rrcb {

namespace {

/// The groups of a rank's points.
struct GroupsHere {
    std::vector<Part> groups;   ///< group of the part of each point
    std::vector<Part> origins;  ///< for each point, the group whose numbers would keep it; no_part
                                ///< if there is none
};

GroupsHere groups_here(std::span<const Part> parts, const PreviousParts& previous,
                       const NumberRule& rule, int rank) {
    GroupsHere here;
    here.groups.resize(parts.size());
    here.origins.resize(parts.size());
    const Origins origins(previous, rule, rank);
    // Only groups of equal size may swap numbers; the last one may be smaller.
    const int num_full = rule.num_parts / rule.shape.group_size;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::int32_t origin = origins.of(i);
        const Part from = origin == no_origin ? no_part : rule.group_of(origin);
        here.groups[i] = rule.group_of_part(parts[i]);
        here.origins[i] = here.groups[i] < num_full && from < num_full ? from : no_part;
    }
    return here;
}

}  // namespace

GroupBuffers::GroupBuffers(const NumberRule& rule, int rank) : parts(rule, rank) {
    if (rule.shape.group_size == 1) return;
    groups.emplace(rule.of_groups(), rank);
    numbers.resize(static_cast<std::size_t>(rule.num_parts));
}

Remap find_numbers(std::span<const Part> parts, const PreviousParts& previous,
                   GroupBuffers& buffers, Participant& self) {
    if (!buffers.groups) return find_numbers(parts, previous, buffers.parts, self);
    const NumberRule& rule = buffers.parts.rule;
    const int rank = mpi::rank_of(self.comm);
    GroupsHere here;
    self.attempt([&] { here = groups_here(parts, previous, rule, rank); });
    const std::vector<Part> numbers_of_groups =
        find_numbers(here.groups, here.origins, *buffers.groups, self).numbers;
    const auto moved = [&](Part part) { return rule.with_group(part, numbers_of_groups); };
    std::ranges::transform(parts, here.groups.begin(), moved);
    Remap remap = find_numbers(here.groups, previous, buffers.parts, self);
    // The search may count fewer: a rank may have numbers of two groups, but a part can only get
    // numbers of its own group.
    std::array<GlobalCount, 2> kept{num_kept(parts, {}, previous, rule, rank),
                                    num_kept(here.groups, remap.numbers, previous, rule, rank)};
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, kept.data(), 2, MPI_INT64_T, MPI_SUM, self.comm),
               "MPI_Allreduce");
    remap.kept_before = kept[0];
    remap.kept_after = std::max(kept[0], kept[1]);
    remap.identity = remap.kept_after == remap.kept_before;
    std::iota(buffers.numbers.begin(), buffers.numbers.end(), Part{0});
    if (!remap.identity)
        for (Part& part : buffers.numbers) part = remap.numbers[moved(part)];
    remap.numbers = std::move(buffers.numbers);
    return remap;
}

}  // namespace rrcb
