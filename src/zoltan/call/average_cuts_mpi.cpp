#include "zoltan/call/average_cuts_mpi.hpp"

#include "collective/communicator.hpp"
#include "cuts/tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rrcb::zoltan {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void widen(Box& box, const Vector& lower, const Vector& upper) {
    for (std::size_t a = 0; a < max_dimension; ++a) {
        box.lower[a] = std::min(box.lower[a], lower[a]);
        box.upper[a] = std::max(box.upper[a], upper[a]);
    }
}

/// Number halfway between two, greater than `lower` and at most `upper`, which is greater.
double between(double lower, double upper) {
    // Not lower + (upper - lower) / 2, which overflows.
    const double middle = lower / 2 + upper / 2;
    return middle > lower ? middle : upper;
}

/// Box of the points of a node, joined from those of its parts. Calls tell(node, box below, box
/// above) for each cut.
template <class Tell>
Box join_boxes(const Cuts& cuts, Descent at, std::span<const Box> of_parts, Tell&& tell) {
    if (at.is_part()) return of_parts[static_cast<std::size_t>(at.first_part)];
    const Box below = join_boxes(cuts, at.lower(), of_parts, tell);
    const Box above = join_boxes(cuts, at.upper(), of_parts, tell);
    tell(at.node, below, above);
    Box both = below;
    widen(both, above.lower, above.upper);
    return both;
}

}  // namespace

void CutAverage::run(const Points& points, std::span<const Part> parts, MPI_Comm comm, Cuts& cuts) {
    std::ranges::fill(boxes_, Box{});
    for (LocalIndex i = 0; i < points.count; ++i) {
        const Vector position = points.position(i);
        widen(boxes_[static_cast<std::size_t>(parts[i])], position, position);
    }
    join_boxes(cuts, root_of(cuts), boxes_,
               [&](std::size_t node, const Box& below, const Box& above) {
                   const auto axis = static_cast<std::size_t>(cuts.tree[node].axis);
                   gaps_[node] = {below.upper[axis], -above.lower[axis]};
               });
    static_assert(sizeof(Gap) == 2 * sizeof(double));
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, gaps_.data(), static_cast<int>(2 * gaps_.size()),
                             MPI_DOUBLE, MPI_MAX, comm),
               "MPI_Allreduce");
    for (std::size_t node = 0; node < gaps_.size(); ++node) {
        const double lower = gaps_[node].lower;
        const double upper = -gaps_[node].minus_upper;
        if (!std::isfinite(lower) || !std::isfinite(upper) || !(lower < upper)) continue;
        Cut& cut = cuts.tree[node];
        // Points on the plane lie above the cut, whatever their other coordinates.
        cut.at.fill(-infinity);
        cut.at[static_cast<std::size_t>(cut.axis)] = between(lower, upper);
    }
}

}  // namespace rrcb::zoltan
