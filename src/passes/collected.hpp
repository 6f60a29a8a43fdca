#pragma once

#include "arithmetic/uninitialized.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/method/bisection.hpp>
#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Copies of the points of one rank whose part is open, because a cut may still end beyond them,
/// and the totals of the others, which are settled.
struct Collected {
    int dimension = 0;
    Uninitialized<double> coordinates;    ///< interleaved
    Uninitialized<double> weights;        ///< empty when every point weighs 1
    Uninitialized<LocalIndex> original;   ///< index of each entry among all points of this rank
    std::vector<double> settled_weights;  ///< of the settled points, one entry per part
    std::vector<double> settled_counts;   ///< likewise

    LocalIndex count() const { return original.size(); }
    double weight(LocalIndex i) const { return weights.empty() ? 1.0 : weights[i]; }
    double coordinate(LocalIndex i, int axis) const {
        return coordinates[i * static_cast<LocalIndex>(dimension) + static_cast<LocalIndex>(axis)];
    }
    Vector position(LocalIndex i) const {
        Vector x{};
        for (int a = 0; a < dimension; ++a) x[static_cast<std::size_t>(a)] = coordinate(i, a);
        return x;
    }
    Points points() const { return interleaved_points(coordinates, dimension, weights); }
};

/// Collects the points whose part may change when each of whole cuts moves in its interval, lower
/// <= x <= upper across its axis, and sets the parts of the others, see assign_settled().
///
/// Two passes, in the memory of another collection. Not collective. Throws std::bad_alloc.
Collected collect(const Points& points, const Cuts& cuts, std::span<const Bracket> intervals,
                  bool has_parts, std::span<Part> parts, Collected memory = {});

/// Collects all points, without parts and totals.
Collected collect_all(const Points& points, Collected memory = {});

/// A node whose cut may end in another interval.
struct Wanted {
    std::size_t node;
    Part first_part;
    int num_parts;
    int axis;
    Bracket interval;

    bool contains(double x) const { return x >= interval.lower && x < interval.upper; }
};

/// Collects settled points in the intervals of these nodes, and takes them from the totals and out
/// of `parts`. Returns the wanted node of each new entry.
///
/// A pass. Nodes have no part in common. Throws std::bad_alloc.
std::vector<std::size_t> collect_more(const Points& points, std::span<const Wanted> wanted,
                                      std::span<Part> parts, Collected& collected);

/// Returns the box of the points of each part, but for those without one. A pass.
std::vector<Box> boxes_of_parts(const Points& points, std::span<const Part> parts, int num_parts);

}  // namespace rrcb
