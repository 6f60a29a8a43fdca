#pragma once

#include "zoltan/handle/state.hpp"

#include <rrcb/cuts.hpp>

namespace rrcb::zoltan {

/// Returns the last partition, for look-ups. Throws ZoltanError if no cuts were kept. Not
/// collective.
const LastPartition& last_of(const State& state);

/// Part and lowest rank of a position. Look-ups are not collective, take one coordinate per
/// dimension, and throw ZoltanError if no cuts were kept.
struct Place {
    int rank = -1;
    int part = -1;
};
Place place_of(const State& state, const double* coordinates);

/// Results of a box look-up. Null arrays are not asked for.
struct Touched {
    int* ranks = nullptr;
    int* num_ranks = nullptr;
    int* parts = nullptr;
    int* num_parts = nullptr;
};

/// Finds the parts a closed box touches and the ranks that hold them, both ascending.
void find_touched(const State& state, const Box& box, const Touched& touched);

/// Returns the region of a part; open sides are +-DBL_MAX, as in Zoltan. Throws ZoltanError for an
/// unknown part.
Box region_of(const State& state, int part);

/// Returns a node of the tree of cuts. Throws ZoltanError for an unknown one.
TreeNode tree_node_of(const State& state, int node);

/// Throws ZoltanError unless part p is on rank p: calls without parts need that.
void require_one_part_per_rank(const PartMap& map, const char* alternative);

}  // namespace rrcb::zoltan
