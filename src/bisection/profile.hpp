#pragma once

#include <rrcb/method/statistical_domain.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace rrcb {

/// The weight of a domain along each axis, to be read at many values, and its extent.
class Profile {
  public:
    Profile() = default;
    explicit Profile(const StatisticalDomain& domain) { take(domain); }

    /// Takes another domain, which is borrowed; reuses the memory.
    void take(const StatisticalDomain& domain);

    const StatisticalDomain& domain() const { return *domain_; }
    double weight() const { return weight_; }
    const Box& extent() const { return extent_; }
    double mean_half_side() const { return mean_half_side_; }  ///< of the patches, by weight

    /// Returns the distance from a cut within which weight counts when axes are compared. Half a
    /// patch side blurs jets and filaments, which are thinner than that.
    double reach() const { return mean_half_side_ / 2; }

    /// Returns the weight below a value.
    double weight_below(int axis, double value) const;
    /// Returns the weight at most `reach` away from a value.
    double weight_within(int axis, double value, double reach) const;

    /// Estimates the ghosts that a cut costs: the weight at most `reach` away from it, or the
    /// weight of all patches if all of it is on one side of the cut.
    ///
    /// `reach` is 0 if the patches are points. Then the weight is assumed to be spread evenly over
    /// the extent of the domain, so that a cut across the longest axis costs the least.
    double weight_near(int axis, double value, double reach) const;

    /// Range in which the cumulative weight passes a target.
    struct Range {
        double lower = -std::numeric_limits<double>::infinity();
        double upper = std::numeric_limits<double>::infinity();
        /// With the target below it; NaN if none was found.
        double value = std::numeric_limits<double>::quiet_NaN();
        double density = 0;  ///< at the value, over half lengths
    };

    /// Looks for the value with the target below it, give or take `error`, by Newton's method, or
    /// false position and bisection if the weight jumps. Begins with `known`, which contains it,
    /// and ends with a range after `most_steps`, or a few if the patches are points.
    Range range_of(int axis, double target, double error, int most_steps, const Range& known) const;
    Range range_of(int axis, double target, double error, int most_steps = 12) const {
        return range_of(axis, target, error, most_steps, Range());
    }

    /// Returns true if the weight grows by more than `error` just below the value of a range, which
    /// has `target` below it, and just above.
    bool grows_at(int axis, const Range& range, double target, double error) const;

  private:
    /// Weight below a value, and density there over half lengths.
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
    std::size_t stride_ = 0;       ///< number of patches, or up to three more of weight 0
    std::vector<double> numbers_;  ///< weights, and for each axis half the lower ends, inverse half
                                   ///< extents, slopes and bows
};

}  // namespace rrcb
