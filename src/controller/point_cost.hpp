#pragma once

namespace rrcb {

/// Sums for the average cost of a point on this rank, in which a step counts half as much as one
/// 100 steps later: noise of 10 % a step leaves less than 1 %.
struct PointCost {
    double load = 0;
    double points = 0;

    /// Takes a step, and returns the points times their average cost; the load if there are none
    /// yet.
    double smoothed(double load_of_step, double points_of_step) {
        constexpr double fading = 0.993;
        load = fading * load + load_of_step;
        points = fading * points + points_of_step;
        return points > 0 ? points_of_step * (load / points) : load_of_step;
    }
};

}  // namespace rrcb
