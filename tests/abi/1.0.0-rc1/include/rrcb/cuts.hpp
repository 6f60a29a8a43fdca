#pragma once

#include <rrcb/points.hpp>
#include <rrcb/stamp.hpp>
#include <rrcb/tree_shape.hpp>

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

/// One cut of the bisection, across `axis`.
///
/// It is a plane at `at[axis]`, with ties broken by position: points exactly on the plane are
/// compared along the other axes in ascending order. If the other entries are -infinity, the cut is
/// a plain plane, and every point on it is above it. A cut at -infinity has nothing below, a cut at
/// +infinity has nothing above.
struct Cut {
    std::int32_t axis = 0;     ///< axis that the cut is across
    std::int32_t divides = 0;  ///< 1: some of the points exactly at it are below, see Coincident
    Vector at{};               ///< position of the plane, and positions that break ties
};

/// Returns true if a position is above a cut or at it. Every look-up consists of this test. Not
/// collective.
///
/// @param cut       of a balance
/// @param position  of a point
/// @param dimension of the points, 1 to 3
RRCB_API bool is_above(const Cut& cut, const Vector& position, int dimension);

/// The tree of a recursive bisection into `num_parts` parts. Everything except `points` is
/// bit-identical on every rank.
///
/// `tree` contains num_parts - 1 cuts in preorder. A node of n parts has shape.lower_parts(n) of
/// them below its cut. The ends of the tree are numbered from the lowest; end k has part
/// part_at(k). That is k, unless parts are dealt to groups, or have kept their numbers when cuts
/// turned.
struct Cuts {
    int dimension = 0;      ///< of the points
    int num_parts = 1;      ///< of the tree
    std::vector<Cut> tree;  ///< in preorder
    TreeShape shape{};      ///< of the tree
    /// Part at each end of the tree; if empty, they are shape.part_at().
    std::vector<Part> numbers{};
    /// Ghosts that other axes would have saved since the axes of these cuts were chosen, as the
    /// number of points whose migration costs as much, divided by the number of all points. The
    /// next balance needs it.
    double debt = 0;
    Stamp stamp{};  ///< of the balance, see unstamped()

    /// Returns true for cuts that no balance has made, such as Cuts{}. Not collective.
    bool empty() const { return dimension == 0 && tree.empty(); }
    /// Returns the part at an end of the tree. Not collective.
    Part part_at(Part end) const {
        return numbers.empty() ? shape.part_at(end, num_parts)
                               : numbers[static_cast<std::size_t>(end)];
    }
    /// Returns true if end k of the tree has part k, for all k. Not collective.
    bool is_numbered_in_order() const { return numbers.empty() && shape.round_robin_block == 0; }
};

/// Stands for no part.
inline constexpr Part no_part = -1;

/// Returns the part of a position.
///
///     const rrcb::Part part = rrcb::part_of(balance.cuts, {0.5, 0.2, 0.1});
///
/// Not collective. Does not check its arguments.
/// @param cuts     of a balance, or other cuts as described at Cut and Cuts
/// @param position in the unit of the points
/// @return no_part if a coordinate is NaN
/// Cost: proportional to the depth of the tree.
RRCB_API Part part_of(const Cuts& cuts, const Vector& position);

/// Writes the part of every point. Not collective.
///
/// @param cuts   of a balance
/// @param points of the dimension of the cuts; weights are ignored
/// @param parts  of length points.count; undefined if the call throws
/// Throws Error if a coordinate is NaN or infinite, arrays have another length, or the cuts are not
/// a tree.
RRCB_API void assign(const Cuts& cuts, const Points& points, std::span<Part> parts);

/// Returns the region of a part; sides without a cut are +-infinity. Not collective.
///
/// With Axes::plain the region is [lower, upper) along each axis, which suits codes with lists of
/// cells. With other cuts, points exactly on a face, as in a lattice, may belong to either side;
/// see Cut.
/// @param cuts of a balance
/// @param part 0 ... num_parts - 1
/// @return the empty box if the cuts leave the part no position, as for parts of size 0
/// Throws Error if there is no such part, or if the cuts are not a tree.
RRCB_API Box box_of(const Cuts& cuts, Part part);

/// Returns the parts whose region touches a closed box. Not collective.
///
/// @param cuts of a balance
/// @param box  in the unit of the points; its bounds must not be NaN
/// @return parts in ascending order; no parts for an empty box. If a cut divides coincident points
/// in the box, the box touches both sides
/// Throws Error for NaN bounds, or if the cuts are not a tree.
RRCB_API std::vector<Part> parts_touching(const Cuts& cuts, const Box& box);

/// Returns the part of every point, as assign(), but throws the errors of all ranks on every rank.
/// Collective.
///
/// @param cuts   of a balance
/// @param points of this rank, which may have none; the dimension must be set on each rank
/// @param comm   of the balance
/// Throws the same Error on every rank: for NaN or infinite coordinates, points of another
/// dimension than the cuts, cuts that are not a tree or differ between ranks, or lack of memory.
/// Cost: local look-ups and one reduction.
[[nodiscard]] RRCB_API std::vector<Part> assign(const Cuts& cuts, const Points& points,
                                                MPI_Comm comm);

}  // namespace rrcb
