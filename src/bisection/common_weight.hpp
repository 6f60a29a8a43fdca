#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/detail/statistical_domain.hpp>

#include <vector>

namespace rrcb {

/// Weight that an end of one tree and a part of other cuts have in common.
struct CommonWeight {
    Part end;
    Part part;
    double weight;
};

/// Returns the weights above 0 that the ends of `cuts` have in common with the parts of `others`.
std::vector<CommonWeight> common_weights(StatisticalDomain domain, const Cuts& cuts,
                                         const Cuts& others);

}  // namespace rrcb
