#pragma once

#include "cuts/tree.hpp"
#include "passes/sorted_points.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/method/bisection.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Consecutive entries of the sorted points that are in one node of the tree: a cell, or a piece of
/// one after cuts.
struct Fragment {
    LocalIndex begin = 0;
    LocalIndex end = 0;
    double weight = 0;
    Box box;                            ///< encloses the entries
    std::int32_t cell_left_out = none;  ///< whose entries may not be sorted yet

    static constexpr std::int32_t none = -1;
};

/// Marks by 1 the cells that the bracket of a cut reaches; a search in the brackets needs their
/// points. Returns an empty vector if these are so many points that sorting all of them is faster.
std::vector<std::uint8_t> cells_in_brackets(const BinnedPoints& binned, const Cuts& cuts,
                                            std::span<const Bracket> brackets);

/// Returns a fragment for every cell that holds points.
std::vector<Fragment> cell_fragments(const SortedPoints& points);

inline bool is_left_out(const Fragment& fragment, const SortedPoints& points) {
    return fragment.cell_left_out != Fragment::none && points.is_left_out(fragment.cell_left_out);
}

/// The points exactly at a cut, which no cut separates. They form one row over all ranks, in the
/// order of the ranks; the first of the row go below the cut.
struct Lot {
    double before = 0;   ///< weight of those on lower ranks
    double below = 0;    ///< weight of the row that belongs below; 0: all of it stays above
    double share = 0.5;  ///< share of the weight of the node that belongs below

    /// Returns the side of a point of the row, the one that it makes less too heavy. `sum` is the
    /// weight of the points of its rank before it.
    bool is_above(double sum, double weight) const {
        return before + sum + (1 - share) * weight > below;
    }
};

/// The points of one rank in a lot, except those of weight 0.
struct PointsInLot {
    double weight = 0;       ///< of all
    double first = 0;        ///< weight of the first of the row
    double last = 0;         ///< weight of the last
    double before_last = 0;  ///< weight of the others
};

/// Returns the weight of all points of the fragments.
double weight_of(const std::vector<Fragment>& fragments);

/// Returns the points exactly at a cut, in the order in which split() takes them below.
PointsInLot points_at(const Cut& cut, const std::vector<Fragment>& fragments,
                      const SortedPoints& points);

/// Returns the fragments below and above a cut. Those it crosses are divided in place: their
/// entries of `points` are permuted.
std::pair<std::vector<Fragment>, std::vector<Fragment>> split(
    const std::vector<Fragment>& fragments, const Cut& cut, const Lot& lot, SortedPoints& points);

/// Sets the part of every point of the fragments by the cuts at `at` and below. Writes the weights
/// of these parts into `weights`, which has one entry per part of the whole tree.
void write_parts(const std::vector<Fragment>& fragments, const Cuts& cuts, const Descent& at,
                 const SortedPoints& points, std::span<Part> parts, std::span<double> weights);

/// Sets the part of every point of the fragments, by its original index, or that of their cell if
/// it is left out; returns their weight.
double write_part(const std::vector<Fragment>& fragments, Part part, const SortedPoints& points,
                  std::span<Part> parts, std::span<Part> parts_of_cells = {});

}  // namespace rrcb
