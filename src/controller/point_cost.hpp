#pragma once

namespace rrcb {

/// Sums for the average cost of a point on this rank. A step counts half as much as one 100 steps
/// later; noise of 10 % in a step is thereby reduced to less than 1 %.
struct PointCost {
    double load = 0;
    double points = 0;

    /// Adds a step. Returns its number of points times the average cost of a point, or its load if
    /// there have been no points yet.
    double smoothed(double load_of_step, double points_of_step) {
        constexpr double fading = 0.993;
        load = fading * load + load_of_step;
        points = fading * points + points_of_step;
        return points > 0 ? points_of_step * (load / points) : load_of_step;
    }
};

}  // namespace rrcb
