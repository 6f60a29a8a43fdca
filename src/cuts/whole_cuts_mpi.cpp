#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "cuts/owned_cuts.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <rrcb/locate.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace rrcb {

namespace {

/// The first part whose first rank is `rank` or a later one.
Part first_part_from(int rank, int num_parts, int num_ranks) {
    Part first = 0;
    Part last = num_parts;
    // Those below `first` begin on earlier ranks, those from `last` on do not.
    while (first < last) {
        const Part middle = first + (last - first) / 2;
        if (ranks_of_part(middle, num_parts, num_ranks).first_rank < rank) {
            first = middle + 1;
        } else {
            last = middle;
        }
    }
    return first;
}

}  // namespace

void write_owned(const Cuts& cuts, int rank, int num_ranks, std::span<Cut> tree) {
    const Part end = first_part_from(rank + 1, cuts.num_parts, num_ranks);
    for (Part part = first_part_from(rank, cuts.num_parts, num_ranks); part < end; ++part) {
        Descent at = root_of(cuts);
        while (!at.is_part()) {
            const bool is_owned = at.first_part == part;
            const Cut* cut = is_owned ? find_cut(cuts, at.node) : nullptr;
            if (is_owned && cut == nullptr)
                reject(
                    "a cut is missing that this rank should know; give the cuts of a balance on "
                    "this communicator");
            if (is_owned) tree[at.node] = *cut;
            at = part >= at.upper().first_part ? at.upper() : at.lower();
        }
    }
}

namespace {

/// Gives every rank all cuts, each of which one rank has and the others hold as zeros. Collective.
void join(std::span<Cut> tree, MPI_Comm comm) {
    static_assert(sizeof(Cut) % sizeof(std::uint64_t) == 0);
    auto* words = reinterpret_cast<std::uint64_t*>(tree.data());
    std::size_t left = tree.size_bytes() / sizeof(std::uint64_t);
    while (left > 0) {
        const std::size_t count = std::min(left, mpi::longest_message / sizeof(std::uint64_t));
        mpi::check(MPI_Allreduce(MPI_IN_PLACE, words, static_cast<int>(count), MPI_UINT64_T,
                                 MPI_BOR, comm),
                   "MPI_Allreduce");
        words += count;
        left -= count;
    }
}

}  // namespace

Cuts whole_cuts(const Cuts& cuts, MPI_Comm user) {
    Participant self{mpi::duplicate_of(user)};
    Cuts whole;
    self.attempt([&] {
        check_tree(cuts);
        whole = is_whole(cuts)
                    ? cuts
                    : Cuts{cuts.dimension, cuts.num_parts,
                           std::vector<Cut>(static_cast<std::size_t>(cuts.num_parts) - 1)};
        if (!is_whole(cuts))
            write_owned(cuts, mpi::rank_of(self.comm), mpi::size_of(self.comm), whole.tree);
    });
    agree(self, {{"the dimension of the cuts", static_cast<std::uint64_t>(cuts.dimension)},
                 {"the number of parts", static_cast<std::uint64_t>(cuts.num_parts)},
                 {"whether the tree is whole", is_whole(cuts) ? 1u : 0u}});
    if (!is_whole(cuts)) join(whole.tree, self.comm);
    return whole;
}

}  // namespace rrcb
