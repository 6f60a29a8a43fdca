#include "controller/point_cost.hpp"

namespace rrcb {

double PointCost::smoothed(double load, double points) {
    constexpr double fading = 0.993;
    load_ = fading * load_ + load;
    points_ = fading * points_ + points;
    return points_ > 0 ? points * (load_ / points_) : load;
}

}  // namespace rrcb
