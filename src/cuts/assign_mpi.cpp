#include "cuts/assign_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "cuts/direct_assignment.hpp"
#include "cuts/path_search.hpp"
#include "cuts/tier_search_mpi.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <cstdint>
#include <optional>

namespace rrcb {

std::vector<Part> assign_all(const Cuts& cuts, const Points& points, Participant& self) {
    std::vector<Part> parts;
    std::optional<SearchBuffers<PathSearch>> buffers;
    self.attempt([&] {
        check_positions(points, cuts);
        parts.resize(points.count);
        if (!assign_known(cuts, points, parts)) reject_coordinates(points);
        if (!is_whole(cuts)) buffers.emplace(PathSearch(cuts, points, parts), self.comm);
    });
    agree(self, {{"the dimension of the cuts", static_cast<std::uint64_t>(cuts.dimension)},
                 {"the number of parts", static_cast<std::uint64_t>(cuts.num_parts)},
                 {"whether the tree is whole", is_whole(cuts) ? 1u : 0u}});
    if (buffers) search_together(*buffers, self);
    number_parts(cuts, parts);
    return parts;
}

std::vector<Part> assign_all(const Cuts& cuts, const Points& points, MPI_Comm user) {
    Participant self{mpi::duplicate_of(user)};
    return assign_all(cuts, points, self);
}

}  // namespace rrcb
