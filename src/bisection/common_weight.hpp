#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/method/statistical_domain.hpp>

#include <vector>

namespace rrcb {

/// Weight of a domain that is in an end of one tree and in a part of other cuts.
struct CommonWeight {
    Part end;
    Part part;
    double weight;
};

/// Returns the weights above 0 that the ends of `cuts` have in common with the parts of `others`.
std::vector<CommonWeight> common_weights(StatisticalDomain domain, const Cuts& cuts,
                                         const Cuts& others);

}  // namespace rrcb
