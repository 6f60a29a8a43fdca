#pragma once

#include "search/slabs.hpp"

#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Copies of one rank's points in slabs, whose parts may change while the cuts move there.
struct UndecidedPoints {
    int dimension = 0;
    std::vector<double> coordinates;      ///< interleaved
    std::vector<double> weights;          ///< empty when every point weighs 1
    std::vector<LocalIndex> original;     ///< index of each entry among all points of this rank,
                                          ///< ascending
    std::vector<Part> parts;              ///< by the current cuts
    std::vector<double> decided_weights;  ///< of the other points, one entry per part

    double weight(LocalIndex i) const { return weights.empty() ? 1.0 : weights[i]; }
    Points points() const { return interleaved_points(coordinates, dimension, weights); }
};

/// Returns the points whose part may change when cuts move in their slabs, by `parts`, those of the
/// current cuts. One pass, in the memory of other undecided points. Throws std::bad_alloc.
UndecidedPoints undecided_points(const Points& points, std::span<const Part> parts,
                                 const Cuts& cuts, std::span<const Slab> slabs,
                                 UndecidedPoints memory = {});

/// Adds up the undecided points in the bins of slabs, see bin_in. Throws std::bad_alloc.
void count_in_slabs(const UndecidedPoints& points, const Cuts& cuts, std::span<const Slab> slabs,
                    std::span<double> counts);

/// Sets the parts of the undecided points, there and in `parts`, by cuts that have moved in their
/// slabs. Writes the weight of all points of this rank in each part. Throws std::bad_alloc.
void assign_undecided(const Cuts& cuts, UndecidedPoints& points, std::span<Part> parts,
                      std::span<double> part_weights);

}  // namespace rrcb
