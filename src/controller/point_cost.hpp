#pragma once

namespace rrcb {

/// Average cost of a point on this rank, in which a step counts half as much as one 30 steps later.
class PointCost {
  public:
    /// Takes a step, and returns what its points cost on average.
    double smoothed(double load, double points);

  private:
    double load_ = 0;
    double points_ = 0;
};

}  // namespace rrcb
