#pragma once

#include "lists/ball_search.hpp"

#include <rrcb/ghosts.hpp>

namespace rrcb {

/// Returns a coordinate shifted by some periods of a box.
double image_of(double x, const Box& box, int axis, std::int32_t shift);

/// Images of balls in a box repeated along its finite axes.
class PeriodicImages {
  public:
    PeriodicImages(const Box& box, int dimension);

    /// Throws Error unless the box is valid, and long enough for the greatest radius.
    void check(double radius) const;
    /// Throws Error, naming the first point outside the box.
    void check(const Points& points) const;

    /// Calls visit(shift, centre) for the images of a ball in the box that reach it along each
    /// axis.
    template <class Visit>
    void for_each(const Ball& ball, Visit&& visit) const {
        Shift first{};
        Shift last{};
        for (int a = 0; a < dimension_; ++a) {
            if (!is_periodic(a)) continue;
            const double x = ball.centre()[a];
            while (ball.reaches(box_.lower[a] - image_of(x, box_, a, first[a] - 1))) --first[a];
            while (ball.reaches(image_of(x, box_, a, last[a] + 1) - box_.upper[a])) ++last[a];
        }
        Shift shift{};
        for (shift[0] = first[0]; shift[0] <= last[0]; ++shift[0])
            for (shift[1] = first[1]; shift[1] <= last[1]; ++shift[1])
                for (shift[2] = first[2]; shift[2] <= last[2]; ++shift[2])
                    visit(shift, image(ball.centre(), shift));
    }

    Vector image(const Vector& x, const Shift& shift) const;

    /// Returns the distances from a position to the box along the axes.
    Vector apart(const Vector& x) const;

    std::uint64_t hash() const;

  private:
    bool is_periodic(int axis) const;

    Box box_;
    int dimension_;
};

}  // namespace rrcb
