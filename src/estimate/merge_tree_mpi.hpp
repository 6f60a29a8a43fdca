#pragma once

#include "collective/merge_tree.hpp"
#include "collective/participant.hpp"
#include "estimate/contribution.hpp"

#include <cstddef>
#include <vector>

namespace rrcb {

/// Sends the contributions of all ranks to rank 0, merged on the way. Collective over `comm`.
///
/// A rank that failed, before or here, sends its number instead of records. A later failure is held
/// back until the next agreement.
void merge_up(Contribution& mine, int dimension, const MergeTree& tree, std::size_t most,
              Participant& self);

/// Appends the records of all ranks to those of the root, by rank. Collective over `comm`: each
/// sends the number of its doubles, then the doubles.
///
/// A failure is held back until the next agreement.
void gather_records(std::vector<double>& records, Participant& self);

}  // namespace rrcb
