#pragma once

#include <rrcb/ghosts.hpp>
#include <rrcb/points.hpp>
#include <rrcb/transfer.hpp>

#include <mpi.h>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace rrcb {

/// Key of a point that is in no group.
inline constexpr std::uint64_t no_group = std::numeric_limits<std::uint64_t>::max();

/// Position of a group in the balance.
enum class GroupPlace {
    centre,  ///< centre of weight, or mean position if all weights are 0. Depends on the
             ///< distribution over the ranks only by rounding. In a periodic box, unwrap each group
             ///< for groups() and wrap its points again for ghost_plan(), or use first_point
    first_point  ///< exact position of the first point on the lowest rank that has points of the
                 ///< group; may change with the distribution over the ranks
};

/// Groups of points that go to one part together, such as bonded particles or bodies. Each group is
/// represented by one point.
struct Groups {
    int dimension = 0;                  ///< of the points
    std::vector<double> coordinates{};  ///< of the groups of this rank, in the order of their first
                                        ///< points here
    std::vector<double> weights{};      ///< sum over all points of each group
    /// Group of each point of this rank. Groups of this rank come first, then those of other ranks,
    /// in the order of fetch() by `plan`.
    std::vector<LocalIndex> of_points{};
    GhostPlan plan{};  ///< between ranks that share groups

    /// Returns a view of this rank's groups as points, for balance(). The groups must outlive the
    /// view. Not collective.
    Points points() const& { return Points(coordinates, dimension, weights); }
    Points points() const&& = delete;
};

/// Finds the groups of all points with equal keys, over all ranks. Collective.
///
/// Balance groups.points() in place of the points; a group that is heavier than a part stays in one
/// part. Then to_points(groups, balance.parts, comm) returns the parts of the points, for plan().
/// Between rebalances call assign() instead of balance().
/// @param points of this rank
/// @param keys   one for each point; no_group for a point that is in no group
/// @param comm   of the ranks with points
/// @param place  must be the same on every rank
/// @return the groups of which this is the lowest rank with points; the same input gives
/// bit-identical results
/// Throws the same Error on every rank: for unusable points, keys of another length, a `place` or
/// dimension that differs between ranks, or lack of memory. Cost: three exchanges, each of
/// ceil(log2 R) messages from each of R ranks and a reduction.
RRCB_API Groups groups(const Points& points, std::span<const std::uint64_t> keys, MPI_Comm comm,
                       GroupPlace place = GroupPlace::centre);

/// Returns the sums of values over the points of each group of this rank, in the order of
/// groups.points(). Collective.
///
/// @param groups     from groups()
/// @param values     `components` for each point of this rank
/// @param comm       of the groups
/// @param components number of values of each point
///
/// Each rank adds in the order of its points; then partial sums are added in ascending order of
/// ranks. Throws Error as accumulate().
RRCB_API std::vector<double> group_sums(const Groups& groups, std::span<const double> values,
                                        MPI_Comm comm, std::size_t components = 1);

namespace detail {

RRCB_API void move(const Groups& groups, std::span<const ByteColumn> columns,
                   const TransferOptions& options, MPI_Comm comm);

}  // namespace detail

/// Returns for each point the values of its group, for example its part. Collective.
///
/// @param groups  from groups()
/// @param columns one entry, or `components`, for each group of this rank
/// @param comm    of the groups
/// @param options  as for transfer()
/// @return as many values for each point of this rank
/// Throws Error as transfer().
template <class Columns>
[[nodiscard]] auto to_points(const Groups& groups, const Columns& columns, MPI_Comm comm,
                             const TransferOptions& options = {}) {
    return detail::moved(groups, columns, comm, options);
}

}  // namespace rrcb
