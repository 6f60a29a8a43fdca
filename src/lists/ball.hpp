#pragma once

#include <rrcb/points.hpp>

#include <algorithm>
#include <limits>

namespace rrcb {

/// All points within a finite radius of a centre; no points if the radius is negative.
class Ball {
  public:
    Ball(const Vector& centre, double radius) : centre_(centre), reach_(reach_of(radius)) {}

    /// Returns the radius, enlarged by the rounding errors of a computed distance.
    static double reach_of(double radius) {
        return std::min(radius * (1 + 4 * epsilon), std::numeric_limits<double>::max());
    }

    /// Returns true if the ball is in the interior of a box.
    bool is_inside(const Box& box, int dimension) const {
        for (int a = 0; a < dimension; ++a)
            if (!(centre_[a] - box.lower[a] > reach_ && box.upper[a] - centre_[a] > reach_))
                return false;
        return true;
    }

    /// Returns true if the ball, enlarged to the radius `at_least` if that is larger, touches a
    /// box.
    bool touches(const Box& box, double at_least, int dimension) const {
        return touches(std::max(reach_, at_least), dimension, [&](int a) {
            return std::max(box.lower[a] - centre_[a], centre_[a] - box.upper[a]);
        });
    }

    /// Returns true if the ball touches a region whose distance from the centre along each axis is
    /// given.
    bool touches(const Vector& apart, int dimension) const {
        return touches(reach_, dimension, [&](int a) { return apart[a]; });
    }

    double reach() const { return reach_; }
    const Vector& centre() const { return centre_; }

    /// Returns the ball with the same centre and the larger of both radii.
    Ball widened(double radius) const {
        Ball ball = *this;
        ball.reach_ = std::max(reach_, reach_of(radius));
        return ball;
    }

    Ball moved_to(const Vector& centre) const {
        Ball ball = *this;
        ball.centre_ = centre;
        return ball;
    }

  private:
    template <class Apart>
    static bool touches(double reach, int dimension, Apart&& apart_along) {
        double square = 0;
        for (int a = 0; a < dimension; ++a) {
            const double apart = apart_along(a);
            if (apart > reach) return false;
            // Computes in units of the reach, so that no square overflows.
            if (apart > 0) square += (apart / reach) * (apart / reach);
        }
        return reach >= 0 && square <= 1 + 8 * epsilon;
    }

    static constexpr double epsilon = std::numeric_limits<double>::epsilon();

    Vector centre_;
    double reach_;
};

}  // namespace rrcb
