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

/// Key of a point which is a group of its own.
inline constexpr std::uint64_t no_group = std::numeric_limits<std::uint64_t>::max();

/// Position of a group in the balance.
enum class GroupPlace {
    centre,  ///< of weight; of the points if all of them weigh 0. Depends on the distribution over
             ///< the ranks by rounding only. In a periodic box unwrap each group for groups(), and
             ///< wrap its points for ghosts(), or use first_point
    first_point  ///< of the lowest rank with one. Its exact position; may change with the ranks
};

/// Points which go to one part together, such as bonded particles or bodies, each group as one
/// point.
struct Groups {
    int dimension = 0;                  ///< of the points
    std::vector<double> coordinates{};  ///< of the groups of this rank, by their first point here
    std::vector<double> weights{};      ///< sums over all points of each
    /// Group of each point of this rank: first the groups of this rank, then of other ranks,
    /// in the order of fetch() by `plan`.
    std::vector<LocalIndex> of_points{};
    GhostPlan plan{};  ///< between ranks sharing groups

    /// Returns a view of the groups of this rank as points, for balance(). The
    /// groups must outlive it. Not collective.
    Points points() const& { return interleaved_points(coordinates, dimension, weights); }
    Points points() const&& = delete;
};

/// Finds the groups of all points with equal keys, over all ranks. Collective.
///
/// Balance groups.points() as any points; a group heavier than a part stays in one part. Then
/// fetch(groups, balance.parts, comm) returns the parts of the points, for plan(). Between
/// rebalances call assign_all() instead of balance().
/// @param points of this rank
/// @param keys   one for each point, no_group if it needs none
/// @param comm   of the ranks with points
/// @param place  the same on every rank
/// @return the groups whose lowest rank with points this is; the same bits for the same input
/// Throws Error on every rank alike: for unusable points, keys of another length, another `place`
/// or dimension than the others, or no memory. Cost: three exchanges, of ceil(log2 R) messages from
/// each of R ranks and a reduction.
RRCB_API Groups groups(const Points& points, std::span<const std::uint64_t> keys, MPI_Comm comm,
                       GroupPlace place = GroupPlace::centre);

/// Returns the sums of values over the points of each group of this rank, in the order of
/// groups.points(). Collective.
///
/// @param groups     of groups()
/// @param values     `components` for each point of this rank
/// @param comm       of the groups
/// @param components sums for each group
///
/// Each rank adds in the order of its points, then partial sums are added by ascending rank. Throws
/// Error as accumulate().
RRCB_API std::vector<double> sums(const Groups& groups, std::span<const double> values,
                                  MPI_Comm comm, std::size_t components = 1);

namespace detail {

RRCB_API void move(const Groups& groups, std::span<const ByteColumn> columns,
                   const TransferLimits& limits, TransferReport* report, MPI_Comm comm);

}  // namespace detail

/// Returns columns of the points with the values of their groups, such as parts. Collective.
///
/// @param groups  of groups()
/// @param columns one entry, or `components`, for each of the groups of this rank
/// @param comm    of the groups
/// @param limits  as for transfer()
/// @param report  as for transfer()
/// @return as many values for each point of this rank
/// Throws Error as transfer().
template <class Columns>
[[nodiscard]] auto fetch(const Groups& groups, const Columns& columns, MPI_Comm comm,
                         const TransferLimits& limits = {}, TransferReport* report = nullptr) {
    return detail::moved(groups, columns, comm, limits, report);
}

}  // namespace rrcb
