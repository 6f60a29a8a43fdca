#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/sorted_points.hpp>

#include <utility>
#include <vector>

namespace rrcb {

/// Consecutive entries of the sorted points that lie in one node of the tree: a cell, or the piece
/// of a cell that earlier cuts left.
struct Fragment {
    LocalIndex first = 0;
    LocalIndex last = 0;
    double weight = 0;
    Box box;  ///< encloses the entries
};

/// A fragment for every cell that holds points.
std::vector<Fragment> cell_fragments(const SortedPoints& points);

/// Fragments below and above a cut. Those it crosses are divided in place: entries of `points`
/// change places within the fragment.
std::pair<std::vector<Fragment>, std::vector<Fragment>> split(
    const std::vector<Fragment>& fragments, const Cut& cut, SortedPoints& points);

/// Sets the part of every point of the fragments, by its original index.
void write_part(const std::vector<Fragment>& fragments, Part part, const SortedPoints& points,
                std::span<Part> parts);

}  // namespace rrcb
