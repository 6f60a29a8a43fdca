#pragma once

#include <rrcb/points.hpp>
#include <rrcb/tree_shape.hpp>

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

/// One cut of the bisection, across `axis`.
///
/// It is a plane at `at[axis]`, with ties broken by position: points exactly on the plane are
/// compared along the other axes in ascending order. The other entries are -infinity for a plain
/// plane, and every point on a plain plane is above it. A cut at -infinity has nothing below, one
/// at +infinity nothing above.
struct Cut {
    std::int32_t axis = 0;     ///< across which the cut is
    std::int32_t divides = 0;  ///< 1: some of the points exactly at it are below, see Coincident
    Vector at{};               ///< position of the plane, and of ties
};

/// Returns true if a position is not below a cut: the only test of every look-up. Not collective.
///
/// @param cut       of a balance
/// @param position  of a point
/// @param dimension of the points, 1 to 3
RRCB_API bool is_above(const Cut& cut, const Vector& position, int dimension);

/// The tree of a recursive bisection into `num_parts` parts; bit-identical on every rank, except
/// `points`.
///
/// `tree` holds num_parts - 1 cuts in preorder. A node of n parts leaves shape.lower_parts(n) of
/// them below its cut. End k of the tree, from the lowest, is part_at(k): k itself unless parts are
/// dealt to groups, or have kept their numbers when cuts turned.
struct Cuts {
    int dimension = 0;      ///< of the points
    int num_parts = 1;      ///< of the tree
    std::vector<Cut> tree;  ///< in preorder
    TreeShape shape{};      ///< of the tree
    /// Part of each end, from the lowest; empty: as shape.part_at().
    std::vector<Part> numbers{};
    /// What the axes of the cuts have cost more than others since they were chosen, as a share of
    /// the points, for the next balance.
    double debt = 0;
    /// Random number of the ranks of the balance, with which calls check their communicator; 0:
    /// none, as of a balance on one rank. Set it to 0 to use the cuts on other ranks.
    std::uint64_t group = 0;
    /// Hash of this rank's points of the balance if one of them has to leave, with which ghosts()
    /// recognizes them; 0: none.
    std::uint64_t points = 0;

    /// Returns true for cuts of no balance, as Cuts{}. Not collective.
    bool empty() const { return dimension == 0 && tree.empty(); }
    /// Returns the part at an end of the tree. Not collective.
    Part part_at(Part end) const {
        return numbers.empty() ? shape.part_at(end, num_parts)
                               : numbers[static_cast<std::size_t>(end)];
    }
    /// Returns true if end k is part k. Not collective.
    bool is_numbered_in_order() const { return numbers.empty() && shape.dealt == 0; }
};

/// Stands for no part.
inline constexpr Part no_part = -1;

/// Returns the part of a position.
///
///     const rrcb::Part part = rrcb::part_of(balance.cuts, {0.5, 0.2, 0.1});
///
/// Not collective. Nothing is checked.
/// @param cuts     of a balance, or others as described at Cut and Cuts
/// @param position in the unit of the points
/// @return no_part if a coordinate is NaN
/// Cost: O(depth).
RRCB_API Part part_of(const Cuts& cuts, const Vector& position);

/// Writes the part of every point. Not collective.
///
/// @param cuts   of a balance
/// @param points of the dimension of the cuts; weights are ignored
/// @param parts  length points.count; void if the call throws
/// Throws Error if a coordinate is NaN or infinite, arrays have another length, or the cuts are no
/// tree.
RRCB_API void assign(const Cuts& cuts, const Points& points, std::span<Part> parts);

/// Returns the region of a part; sides without a cut are +-infinity. Not collective.
///
/// With Axes::plain the region is [lower, upper) along each axis, for codes with lists of cells. By
/// other cuts, points exactly on a face, as in a lattice, may belong to either side (see
/// Cut).
/// @param cuts of a balance
/// @param part 0 ... num_parts - 1
/// @return the empty box if the cuts leave no position to the part, as for parts of size 0
/// Throws Error for a number of no part and for cuts which are no tree.
RRCB_API Box box_of(const Cuts& cuts, Part part);

/// Returns the parts whose region a closed box touches. Not collective.
///
/// @param cuts of a balance
/// @param box  in the unit of the points; bounds are not NaN
/// @return parts in ascending order, none for an empty box. If a cut divides coincident
/// points in the box, both of its sides are touched
/// Throws Error for NaN bounds and for cuts which are no tree.
RRCB_API std::vector<Part> parts_touching(const Cuts& cuts, const Box& box);

/// Returns the part of every point, as assign(), but with the errors of all ranks. Collective.
///
/// @param cuts   of a balance
/// @param points of this rank, or none; each rank states the dimension
/// @param comm   of the balance
/// Throws Error on every rank alike: for NaN or infinite coordinates, points of another dimension
/// than the cuts, cuts which are no tree or differ between ranks, or no memory. Cost: local
/// look-ups and one reduction.
[[nodiscard]] RRCB_API std::vector<Part> assign_all(const Cuts& cuts, const Points& points,
                                                    MPI_Comm comm);

}  // namespace rrcb
