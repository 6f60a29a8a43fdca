#pragma once

#include "ranks.hpp"

#include <rrcb/plan.hpp>

#include <vector>

namespace rrcb::test {

/// The ranks of each part where nothing else is asked for.
inline std::vector<RankRange> ranks_of_parts(int num_parts, int num_ranks = test::num_ranks()) {
    std::vector<RankRange> ranks;
    for (Part part = 0; part < num_parts; ++part)
        ranks.push_back(ranks_of_part(part, num_parts, num_ranks));
    return ranks;
}

}  // namespace rrcb::test
