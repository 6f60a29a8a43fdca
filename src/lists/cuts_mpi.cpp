#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "lists/duplicated_mpi.hpp"
#include "options/request.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace rrcb {

void join_cuts(std::span<Cut> tree, Participant& self) {
    static_assert(sizeof(Cut) % sizeof(std::uint64_t) == 0);
    auto* words = reinterpret_cast<std::uint64_t*>(tree.data());
    std::size_t left = tree.size_bytes() / sizeof(std::uint64_t);
    while (left > 0) {
        const std::size_t count = std::min(left, mpi::longest_message / sizeof(std::uint64_t));
        self.check(MPI_Allreduce(MPI_IN_PLACE, words, static_cast<int>(count), MPI_UINT64_T,
                                 MPI_BOR, self.comm),
                   "MPI_Allreduce");
        words += count;
        left -= count;
    }
}

std::vector<Part> assign(const Cuts& cuts, const Points& points, Participant& self) {
    std::vector<Part> parts;
    std::uint64_t bits_of_cuts = 0;
    self.attempt([&] {
        parts.resize(points.count);
        assign(cuts, points, parts);
        bits_of_cuts = bits_of(cuts);
    });
    agree(self, {{"the dimension of the cuts", static_cast<std::uint64_t>(cuts.dimension)},
                 {"the number of parts", static_cast<std::uint64_t>(cuts.num_parts)},
                 {"the tree of cuts", bits_of_cuts}});
    return parts;
}

std::vector<Part> assign(const Cuts& cuts, const Points& points, MPI_Comm user) {
    Participant self = mpi::enter(user, CallName::assign);
    std::vector<Part> parts = assign(cuts, points, self);
    self.throw_failed_message();
    return parts;
}

}  // namespace rrcb
