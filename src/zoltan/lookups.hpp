#pragma once

#include "state.hpp"

#include <rrcb/cuts.hpp>

#include <vector>

namespace rrcb::zoltan {

/// Part and lowest rank of a position; `coordinates` has one entry per dimension. Not collective.
/// All look-ups throw Failure when no cuts were kept.
struct Place {
    int rank = -1;
    int part = -1;
};
Place place_of(const State& state, const double* coordinates);

/// Parts a closed box touches and the ranks that hold them, both ascending.
struct Touched {
    std::vector<int> ranks;
    std::vector<int> parts;
};
Touched touched_by(const State& state, const Box& box);

/// Region of a part; open sides are +-DBL_MAX, as in Zoltan. Throws Failure for an unknown part.
Box region_of(const State& state, int part);

/// Throws Failure unless part p is on rank p, which the look-ups without parts ask for.
void require_one_part_per_rank(const State& state, const char* alternative);

}  // namespace rrcb::zoltan
