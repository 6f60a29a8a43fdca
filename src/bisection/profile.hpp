#pragma once

#include <rrcb/detail/statistical_domain.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace rrcb {

/// Extent of a domain and its weight along each axis, prepared for reading at many values.
class Profile {
  public:
    Profile() = default;
    explicit Profile(const StatisticalDomain& domain) { take(domain); }

    /// Replaces the domain, which is borrowed, and reuses the memory.
    void take(const StatisticalDomain& domain);

    const StatisticalDomain& domain() const { return *domain_; }
    double weight() const { return weight_; }
    const Box& extent() const { return extent_; }
    /// mean of the patches, by weight
    double mean_half_side() const { return mean_half_side_; }

    /// Returns the distance from a cut up to which weight counts when axes are compared. It is a
    /// quarter of a patch side: half a side would be more than the thickness of jets and filaments.
    double reach() const { return mean_half_side_ / 2; }

    /// Returns the weight below a value.
    double weight_below(int axis, double value) const;
    /// Returns the weight at most `reach` away from a value.
    double weight_within(int axis, double value, double reach) const;

    /// Estimates the ghosts that a cut costs: the weight at most `reach` away from it, or the
    /// weight of all patches if all of it is on one side of the cut.
    ///
    /// A `reach` of 0 means that the patches are points. Then the weight is assumed to be spread
    /// evenly over the extent of the domain, so that a cut across the longest axis costs least.
    double weight_near(int axis, double value, double reach) const;

    /// Range in which the cumulative weight passes a target.
    struct Range {
        double lower = -std::numeric_limits<double>::infinity();
        double upper = std::numeric_limits<double>::infinity();
        /// Has the target weight below it; NaN if no such value was found.
        double value = std::numeric_limits<double>::quiet_NaN();
        double density = 0;  ///< at the value, as weight per half length
    };

    /// Searches for the value with the weight `target` below it, within `error`, by Newton's
    /// method. If the weight jumps, uses false position and bisection. The search starts from
    /// `known`, which must contain the value, and returns a range after `most_steps` steps, or
    /// after a few if the patches are points.
    Range range_of(int axis, double target, double error, int most_steps, const Range& known) const;
    Range range_of(int axis, double target, double error, int most_steps = 12) const {
        return range_of(axis, target, error, most_steps, Range());
    }

    /// Returns true if the weight grows by more than `error` both just below and just above
    /// range.value, which has `target` below it.
    bool grows_at(int axis, const Range& range, double target, double error) const;

  private:
    /// Weight below a value, and density there as weight per half length.
    struct Reading {
        double below = 0;
        double density = 0;
    };
    Reading read(int axis, double half) const;
    std::array<double, 2> weights_below(int axis, const std::array<double, 2>& halves) const;
    const double* numbers_of(int axis) const;
    template <std::size_t dimension>
    void take_patches();

    const StatisticalDomain* domain_ = nullptr;
    double weight_ = 0;
    Box extent_{};
    double mean_half_side_ = 0;
    std::size_t stride_ = 0;       ///< number of patches, padded with up to three of weight 0
    std::vector<double> numbers_;  ///< weights, and for each axis half the lower ends, inverse half
                                   ///< extents, slopes and bows
};

}  // namespace rrcb
