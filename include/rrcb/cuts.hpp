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
/// A plane at `at[axis]`, with ties broken by position: points that lie exactly on the plane are
/// compared along the other axes in ascending order. The other entries are -infinity for a plain
/// plane, of which every point on it is above. A cut at -infinity has nothing below, one at
/// +infinity nothing above.
struct Cut {
    std::int32_t axis = 0;     ///< that the cut is across
    std::int32_t divides = 0;  ///< 1: of the points exactly at it some lie below, see Coincident
    Vector at{};               ///< where, as told above
};

/// Returns true if `position` is not below the cut: the one test behind every look-up. Not
/// collective.
RRCB_API bool is_above(const Cut& cut, const Vector& position, int dimension);

/// The tree of a recursive bisection into `num_parts` parts.
///
/// `tree` holds num_parts - 1 cuts in preorder. A node of n parts leaves shape.lower_parts(n) of
/// them below its cut. End k of the tree, from the lowest, is part shape.part_at(k, num_parts): k
/// itself unless parts are dealt to groups. Same bits on every rank after `balance`.
///
/// With Options::cuts = own, if many ranks make the parts, `tree` holds only some cuts: those
/// above the points and the parts of this rank, and `nodes` contains their numbers, also on a rank
/// that happens to have all. Then look-ups that need other cuts fail on this rank alone; the
/// collective assign_all() and ghosts() work with both kinds, and gather_cuts() makes the one of
/// the other.
struct Cuts {
    int dimension = 0;      ///< of the points
    int num_parts = 1;      ///< of the whole tree
    std::vector<Cut> tree;  ///< in preorder
    /// Number in preorder of each cut of `tree`, ascending, where it holds some of them only;
    /// empty: all.
    std::vector<std::int32_t> nodes{};
    TreeShape shape{};  ///< of the whole tree
};

/// Returns true if cuts are the whole tree, the same on every rank, so that look-ups work
/// everywhere. Not collective.
inline bool is_whole(const Cuts& cuts) {
    return cuts.nodes.empty();
}

/// Stands for a part that the cuts do not determine.
inline constexpr Part no_part = -1;

/// Returns the part of a position; no_part if a coordinate is NaN, or if the cuts that decide are
/// not known.
///
/// Not collective; O(depth), by a logarithm more if the tree is not whole. Nothing else is checked:
/// the cuts are those of a balance, or fulfil what is written at Cut and Cuts.
RRCB_API Part part_of(const Cuts& cuts, const Vector& position);

/// Writes the part of every point into `parts` (length points.count). Not collective.
///
/// Throws Error if a coordinate is NaN or infinite, arrays have another length, the points another
/// dimension than the cuts, or the cuts are no tree; `parts` is void then. With cuts that are not
/// whole also, on this rank alone, if it lacks a cut above a point: call assign_all(cuts, points,
/// comm) instead. Weights are not looked at.
RRCB_API void assign(const Cuts& cuts, const Points& points, std::span<Part> parts);

/// Returns the region of a part; open sides are +-infinity. Lower faces belong to it, upper faces
/// do not, except for ties (see Cut). Not collective.
///
/// The region is the empty box if the cuts leave no position to the part, as they do to parts of
/// size 0, unless one of them divides points there. Throws Error for a number that is no part and
/// cuts that are no tree; with cuts that are not whole also, on this rank alone, if it lacks a cut
/// above the part: call gather_cuts() before.
RRCB_API Box box_of(const Cuts& cuts, Part part);

/// Returns the parts whose region a closed box touches, ascending; none for an empty box. Not
/// collective.
///
/// Where the box holds the place of points that a cut divides, both sides of it are touched. A part
/// whose region is empty is never touched. Throws Error for bounds that are NaN and cuts that are
/// no tree; with cuts that are not whole also, on this rank alone, if it lacks a cut that may cross
/// the box: call gather_cuts() before.
RRCB_API std::vector<Part> parts_touching(const Cuts& cuts, const Box& box);

/// Returns the part of each of any points, by whole cuts or by cuts of which each rank has some.
///
/// Collective over `comm`, that of the balance; each rank gives points of its own, or none, and
/// states their dimension. Throws Error on every rank alike: for coordinates that are NaN or
/// infinite, points of another dimension than the cuts, cuts that gather_cuts() would refuse, or no
/// memory. Cost: with whole cuts a local look-up and one reduction; otherwise the ranks ask the
/// owners of the cuts that they lack, see docs/design/many_ranks.md.
RRCB_API std::vector<Part> assign_all(const Cuts& cuts, const Points& points, MPI_Comm comm);

/// Returns the whole tree of cuts of which each rank holds a part; cuts that are whole come back
/// as they are.
///
/// Collective over `comm`, that of the balance. Throws Error on every rank alike: if cuts are no
/// tree, those of the ranks are of trees of other dimensions or numbers of parts, whole trees
/// differ, a rank lacks the cut of a node whose lowest part begins on this rank, or has no memory.
/// Cost: one reduction of 32 bytes a part, which every rank has to hold.
RRCB_API Cuts gather_cuts(const Cuts& cuts, MPI_Comm comm);

}  // namespace rrcb
