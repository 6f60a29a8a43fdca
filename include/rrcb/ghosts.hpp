#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/transfer.hpp>

#include <mpi.h>

#include <span>
#include <vector>

namespace rrcb {

/// Who needs which points of whom; no two entries of a list of ranks name the same one.
struct GhostPlan {
    LocalIndex num_points = 0;             ///< that this rank holds
    std::vector<RankCount> send;           ///< how many of them which ranks need; ranks ascending
    std::vector<LocalIndex> send_indices;  ///< for one rank after the other, ascending for each
    std::vector<RankCount> receive;        ///< how many come from which ranks; ranks ascending
};

/// The points that other ranks need within a cut-off `radius`, from the cuts alone.
///
/// Collective over `comm`: ceil(log2 R) messages from each of R ranks, one more from some, to tell
/// what comes, then one reduction. Where ranks know a part of the cuts each, one such pass more;
/// and where some lacks cuts near its points, which it then asks the owners for as assign_all()
/// does, one to share cuts, two for each time that some rank asks, and the first pass and the
/// reduction again. The plan is the same as by the whole tree.
///
/// A rank needs the points of others whose distance to the region of one of its parts, the closed
/// box_of(cuts, part), is at most `radius`; none for a part whose region is empty. So of any two
/// points in the regions of their ranks that are that near each rank gets the other's. A distance
/// of exactly `radius` counts, and to lose none by rounding so do those up to 8 units in the last
/// place beyond. Points may lie anywhere, also outside the regions of their own rank, and are sent
/// to each rank once. Ranks that share a part need all the points in it of each other. The radius
/// is in the unit of the coordinates, finite, 0 or more.
///
/// Parts lie on ranks_of_part. Memory as there are points to send, 100 bytes for each rank that
/// they go to or come from, and 5 kB for each 127 cuts that the rank asks for: none grows with the
/// number of ranks or parts. In time O(1) for a point farther than `radius` inside the only part
/// of its rank, and otherwise as the number of regions it is near times the depth of the tree.
///
/// Throws Error on every rank alike where one has unusable points, another radius or other cuts
/// than the others, cuts of another dimension than its points or that gather_cuts() would refuse,
/// or no memory.
RRCB_API GhostPlan ghosts(const Cuts& cuts, const Points& points, double radius, MPI_Comm comm);

/// The same where the parts lie on other ranks, as after a remap(): part p on ranks_of_parts[p],
/// given alike on every rank.
RRCB_API GhostPlan ghosts(const Cuts& cuts, const Points& points, double radius,
                          std::span<const RankRange> ranks_of_parts, MPI_Comm comm);

namespace detail {

RRCB_API void move(const GhostPlan& plan, std::span<const ByteColumn> columns,
                   const TransferLimits& limits, TransferReport* report, MPI_Comm comm);

}  // namespace detail

/// Columns of the ghosts of this rank: by rank, as in plan.receive, and as they lie there.
///
/// Collective over `comm`, otherwise as transfer(): columns hold one entry, or `components`, for
/// each of plan.num_points points. To be called with the same plan as long as no point changes its
/// place in the columns.
template <class Columns>
auto fetch(const GhostPlan& plan, const Columns& columns, MPI_Comm comm,
           const TransferLimits& limits = {}, TransferReport* report = nullptr) {
    return detail::moved(plan, columns, comm, limits, report);
}

}  // namespace rrcb
