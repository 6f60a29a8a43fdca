#pragma once

#include "lists/remap_mpi.hpp"

#include <span>
#include <vector>

namespace rrcb {

/// A number for each part, every number once, so that many points stay on their rank; the origins
/// of `overlaps`, one for each pair, are ranks.
///
/// Ranks take parts until their numbers are used up, the largest overlap first, which keeps at
/// least half of the most that can stay. Of the parts of a rank those that can keep their number
/// do, the others get what is left, ascending. Not collective. In time as a sort of the overlaps,
/// however many parts a rank has.
std::vector<Part> numbers_by_rank(std::span<const Overlap> overlaps,
                                  std::span<const RankRange> ranks_of_parts);

}  // namespace rrcb
