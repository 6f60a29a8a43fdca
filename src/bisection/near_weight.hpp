#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/method/statistical_domain.hpp>

namespace rrcb {

/// Returns half the mean side of the patches, by weight.
double mean_half_side(const StatisticalDomain& domain);

/// Returns the weight within `reach` of a plane.
double weight_within(const StatisticalDomain& domain, const Cut& plane, double reach);

/// Estimates the ghosts that a cut of a domain costs, by the weight near it: within half a mean
/// side of the patches, a length that is the same across all axes.
///
/// If `reach` is 0, as of patches without sides, the domain is taken as an even box: the weight
/// over its extent across the cut. Then the longest axis costs the least.
class NearWeight {
  public:
    /// `extent` is the box of the domain, which is borrowed.
    NearWeight(const StatisticalDomain& domain, const Box& extent, double reach)
        : domain_(domain), extent_(extent), reach_(reach) {}

    double reach() const { return reach_; }

    /// Returns the whole weight if all of it is on one side.
    double operator()(const Cut& cut) const;

  private:
    const StatisticalDomain& domain_;
    const Box& extent_;
    double reach_ = 0;
};

}  // namespace rrcb
