#pragma once

#include <rrcb/method/statistical_domain.hpp>

#include <array>
#include <limits>
#include <vector>

namespace rrcb {

/// The weight of a domain along an axis, to be read at many values.
class Profile {
  public:
    Profile() = default;
    Profile(const StatisticalDomain& domain, int axis) { take(domain, axis); }

    /// Takes another domain, which is borrowed; reuses the memory.
    void take(const StatisticalDomain& domain, int axis);

    const StatisticalDomain& domain() const { return *domain_; }
    int axis() const { return axis_; }
    double weight() const { return weight_; }
    double lower() const { return lower_; }  ///< end of the patches
    double upper() const { return upper_; }  ///< end of the patches

    /// Returns the weight below a value, and within `reach` of one.
    double weight_below(double value) const;
    double weight_within(double value, double reach) const;

    /// Estimates the ghosts that a cut costs, by the weight near it; all weight if all of it is on
    /// one side.
    ///
    /// If `reach` is 0, as of patches without sides, the domain is taken as an even box: the weight
    /// over its extent. Then the longest axis costs the least.
    double weight_near(double value, double reach) const;

    /// Range in which the cumulative weight passes a target.
    struct Range {
        double lower = -std::numeric_limits<double>::infinity();
        double upper = std::numeric_limits<double>::infinity();
        /// With the target below it; NaN if none was found.
        double value = std::numeric_limits<double>::quiet_NaN();
    };

    /// Looks for the value with the target below it, give or take `error`, by Newton's method, or
    /// false position if the weight jumps. Ends with a range after `most_steps`.
    Range range_of(double target, double error, int most_steps = 12) const;

    /// Returns true if the weight grows by more than `error` just below a value, and just above.
    bool grows_at(double value, double error) const;

    using Lanes = std::array<double, 4>;

    /// Slices of four patches, in units in which they reach from 0 to 1.
    struct Block {
        Lanes half_lower;
        Lanes inverse;  ///< of half the extent
        Lanes weight;
        Lanes slope;
        Lanes bow;
    };

  private:
    const StatisticalDomain* domain_ = nullptr;
    int axis_ = 0;
    double lower_ = 0;
    double upper_ = 0;
    double weight_ = 0;
    std::vector<Block> blocks_;
};

}  // namespace rrcb
