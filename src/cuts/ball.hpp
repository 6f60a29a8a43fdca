#pragma once

#include <rrcb/points.hpp>

#include <algorithm>
#include <limits>

namespace rrcb {

/// The points within a radius, which is finite, of a centre; none if it is below 0.
class Ball {
  public:
    Ball(const Vector& centre, double radius)
        : centre_(centre),
          reach_(std::min(radius * (1 + 4 * epsilon), std::numeric_limits<double>::max())),
          unit_(reach_ > 0 ? reach_ : 1) {}

    /// Returns true if the ball is in the interior of a box.
    bool is_inside(const Box& box, int dimension) const {
        for (int a = 0; a < dimension; ++a)
            if (!(centre_[a] - box.lower[a] > reach_ && box.upper[a] - centre_[a] > reach_))
                return false;
        return true;
    }

    /// Returns true if the ball touches a region at these distances from the centre along the axes.
    bool touches(const Vector& apart, int dimension) const {
        double square = 0;
        for (int a = 0; a < dimension; ++a) {
            if (apart[a] > reach_) return false;
            if (apart[a] > 0) square += (apart[a] / unit_) * (apart[a] / unit_);
        }
        return square <= 1 + 8 * epsilon;
    }

    bool reaches(double distance) const { return distance <= reach_; }

    const Vector& centre() const { return centre_; }

    /// Returns the ball of the greater of two radii.
    Ball widened(double radius) const {
        const Ball other(centre_, radius);
        return other.reach_ > reach_ ? other : *this;
    }

    Ball moved_to(const Vector& centre) const {
        Ball ball = *this;
        ball.centre_ = centre;
        return ball;
    }

  private:
    static constexpr double epsilon = std::numeric_limits<double>::epsilon();

    Vector centre_;
    double reach_;  ///< the radius, plus the rounding errors of a distance
    double unit_;   ///< of lengths, so that their squares do not overflow
};

}  // namespace rrcb
