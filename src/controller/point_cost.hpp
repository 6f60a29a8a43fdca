#pragma once

#include <array>

namespace rrcb {

/// Average cost of a point on this rank, in which a step counts half as much as one 100 steps
/// later: noise of 10 % a step leaves less than 1 %.
class PointCost {
  public:
    PointCost() = default;
    PointCost(double load, double points) : load_(load), points_(points) {}

    /// Takes a step, and returns the points times their average cost; `load` if there are none yet.
    double smoothed(double load, double points) {
        constexpr double fading = 0.993;
        load_ = fading * load_ + load;
        points_ = fading * points_ + points;
        return points_ > 0 ? points * (load_ / points_) : load;
    }

    /// Returns the sums of loads and points, of which another one can be made.
    std::array<double, 2> sums() const { return {load_, points_}; }

  private:
    double load_ = 0;
    double points_ = 0;
};

}  // namespace rrcb
