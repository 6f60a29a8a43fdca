#include "collective/agreement_mpi.hpp"
#include "collective/duplicate.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/tier_search_mpi.hpp"
#include "options/request.hpp"
#include "options/validation.hpp"
#include "passes/assignment.hpp"

#include <cstdint>
#include <optional>

namespace rrcb {

std::vector<Part> assign_all(const Cuts& cuts, const Points& points, Participant& self) {
    std::vector<Part> parts;
    std::optional<SearchBuffers<PathSearch>> buffers;
    std::uint64_t bits_of_cuts = 0;
    self.attempt([&] {
        check_positions(points, cuts);
        bits_of_cuts = bits_of(cuts);
        parts.resize(points.count);
        if (!assign_known(cuts, points, parts)) reject_coordinates(points);
        if (!is_whole(cuts)) buffers.emplace(PathSearch(cuts, points, parts), self.comm);
    });
    agree(self, {{"the dimension of the cuts", static_cast<std::uint64_t>(cuts.dimension)},
                 {"the number of parts", static_cast<std::uint64_t>(cuts.num_parts)},
                 {"whether the tree is whole", is_whole(cuts) ? 1u : 0u},
                 {"the tree of cuts", bits_of_cuts}});
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
