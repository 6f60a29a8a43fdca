#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "cuts/owned_cuts.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/tier_search_mpi.hpp"
#include "options/request.hpp"
#include "options/validation.hpp"
#include "passes/assignment.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace rrcb {

namespace {

/// Gives every rank of `comm` all cuts; at the call one rank has each cut, the others zeros.
/// Collective over `comm`; `self` holds errors back.
void join_cuts(std::span<Cut> tree, MPI_Comm comm, Participant& self) {
    static_assert(sizeof(Cut) % sizeof(std::uint64_t) == 0);
    auto* words = reinterpret_cast<std::uint64_t*>(tree.data());
    std::size_t left = tree.size_bytes() / sizeof(std::uint64_t);
    while (left > 0) {
        const std::size_t count = std::min(left, mpi::longest_message / sizeof(std::uint64_t));
        self.check(MPI_Allreduce(MPI_IN_PLACE, words, static_cast<int>(count), MPI_UINT64_T,
                                 MPI_BOR, comm),
                   "MPI_Allreduce");
        words += count;
        left -= count;
    }
}

/// Throws on all ranks if one has failed, or if their cuts differ. Collective.
void agree_on(const Cuts& cuts, Participant& self) {
    std::uint64_t bits_of_cuts = 0;
    self.attempt([&] { bits_of_cuts = bits_of(cuts); });
    agree(self, {{"the dimension of the cuts", static_cast<std::uint64_t>(cuts.dimension)},
                 {"the number of parts", static_cast<std::uint64_t>(cuts.num_parts)},
                 {"whether the tree is whole", is_whole(cuts) ? 1u : 0u},
                 {"the tree of cuts", bits_of_cuts}});
}

}  // namespace

Cuts gather_cuts(const Cuts& cuts, Participant& self) {
    Cuts whole;
    self.attempt([&] {
        check_tree(cuts);
        whole = cuts;
        if (is_whole(cuts)) return;
        whole.nodes.clear();
        whole.tree.assign(static_cast<std::size_t>(cuts.num_parts) - 1, {});
        for_each_owned(cuts, mpi::rank_of(self.comm), mpi::size_of(self.comm),
                       [&](std::size_t node, const Cut& cut) { whole.tree[node] = cut; });
    });
    agree_on(cuts, self);
    if (!is_whole(cuts)) join_cuts(whole.tree, self.comm, self);
    self.throw_alone();
    return whole;
}

Cuts gather_cuts(const Cuts& cuts, MPI_Comm user) {
    Participant self = mpi::enter(user, CallName::gather_cuts);
    return gather_cuts(cuts, self);
}

std::vector<Part> assign_all(const Cuts& cuts, const Points& points, Participant& self) {
    std::vector<Part> parts;
    std::optional<SearchBuffers<PathSearch>> buffers;
    self.attempt([&] {
        check_positions(points, cuts);
        parts.resize(points.count);
        if (!assign_known(cuts, points, parts)) reject_coordinates(points);
        if (!is_whole(cuts)) buffers.emplace(PathSearch(cuts, points, parts), self.comm);
    });
    agree_on(cuts, self);
    if (buffers) search_together(*buffers, self);
    number_parts(cuts, parts);
    return parts;
}

std::vector<Part> assign_all(const Cuts& cuts, const Points& points, MPI_Comm user) {
    Participant self = mpi::enter(user, CallName::assign_all);
    std::vector<Part> parts = assign_all(cuts, points, self);
    self.throw_failed_message();
    return parts;
}

}  // namespace rrcb
