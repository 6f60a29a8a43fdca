#pragma once

namespace rrcb {

/// Average cost of a point on this rank, in which a step counts half as much as one 100 steps
/// later: noise of 10 % a step leaves less than 1 %.
class PointCost {
  public:
    /// Takes a step, and returns the points times their average cost; `load` if there are none yet.
    double smoothed(double load, double points) {
        constexpr double fading = 0.993;
        load_ = fading * load_ + load;
        points_ = fading * points_ + points;
        return points_ > 0 ? points * (load_ / points_) : load;
    }

  private:
    double load_ = 0;
    double points_ = 0;
};

}  // namespace rrcb
