#pragma once

#include "lists/ball.hpp"

#include <rrcb/ghosts.hpp>

#include <array>
#include <tuple>
#include <utility>

namespace rrcb {

/// Returns a coordinate shifted by a number of periods of the box.
double image_of(double x, const Box& box, int axis, std::int32_t shift);

/// Images of balls in a box that is repeated along each axis on which it is finite.
class PeriodicImages {
  public:
    PeriodicImages(const Box& box, int dimension);

    /// Throws Error unless the box is valid and long enough for the largest radius.
    void check(double radius) const;
    /// Throws Error that names the first point outside the box. `all` is the box of the points.
    void check(const Points& points, const Box& all) const;

    const Box& box() const { return box_; }

    /// Calls visit(lower, upper) for an interval along an axis, and for all its images within
    /// `reach` of the box.
    template <class Visit>
    void for_each_along(int axis, const std::array<double, 2>& ends, double reach,
                        Visit&& visit) const {
        const auto [first, last] = shifts_along(axis, ends[0], ends[1], reach);
        for (std::int32_t shift = first; shift <= last; ++shift)
            visit(image_of(ends[0], box_, axis, shift), image_of(ends[1], box_, axis, shift));
    }

    /// Calls visit(shift, centre) for the images of a ball that come within its radius of the box
    /// along each axis.
    template <class Visit>
    void for_each(const Ball& ball, Visit&& visit) const {
        Shift first{};
        Shift last{};
        for (int a = 0; a < dimension_; ++a) {
            const double x = ball.centre()[a];
            std::tie(first[a], last[a]) = shifts_along(a, x, x, ball.reach());
        }
        Shift shift{};
        for (shift[0] = first[0]; shift[0] <= last[0]; ++shift[0])
            for (shift[1] = first[1]; shift[1] <= last[1]; ++shift[1])
                for (shift[2] = first[2]; shift[2] <= last[2]; ++shift[2])
                    visit(shift, image(ball.centre(), shift));
    }

    Vector image(const Vector& x, const Shift& shift) const;

    std::uint64_t hash() const;

  private:
    bool is_periodic(int axis) const;

    /// Returns the first and the last shift with which an interval along an axis is within reach of
    /// the box.
    std::pair<std::int32_t, std::int32_t> shifts_along(int axis, double lower, double upper,
                                                       double reach) const {
        std::pair<std::int32_t, std::int32_t> shifts{};
        auto& [first, last] = shifts;
        if (!is_periodic(axis)) return shifts;
        while (box_.lower[axis] - image_of(upper, box_, axis, first - 1) <= reach) --first;
        while (image_of(lower, box_, axis, last + 1) - box_.upper[axis] <= reach) ++last;
        return shifts;
    }

    Box box_;
    int dimension_;
};

}  // namespace rrcb
