#pragma once

#include "search/slabs.hpp"

#include <rrcb/passes.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Adds up the collected points, of these parts, in the bins of slabs, see bin_in. Throws
/// std::bad_alloc.
void count_in_slabs(const Collected& collected, std::span<const Part> parts, const Cuts& cuts,
                    std::span<const Slab> slabs, std::span<double> counts);

/// Sets the parts of the collected points by cuts that have moved in their slabs. Writes the weight
/// of all points of this rank in each part. Throws std::bad_alloc.
void assign_collected(const Cuts& cuts, const Collected& collected, std::vector<Part>& parts,
                      std::span<double> part_weights);

}  // namespace rrcb
