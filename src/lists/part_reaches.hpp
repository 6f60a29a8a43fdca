#pragma once

#include "arithmetic/infinity.hpp"
#include "lists/ball.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace rrcb {

/// Distances within which the points of each part need other points.
///
/// Each part has two reaches. The first is the largest radius, with the box of all points whose
/// radius is more than half of it. The second is the largest of the other radii, with the box of
/// the other points. Parts are numbered as the ends of the tree.
class PartReaches {
  public:
    /// Starts with parts that need no points. Throws std::bad_alloc.
    PartReaches(int num_parts, int dimension)
        : dimension_(dimension), numbers_(num_parts * width(), -infinity) {}

    /// Notes the radius of a point of this rank. All radii must be noted before any box.
    void note_radius(Part end, double radius) { raise(numbers_[end * width()], radius); }

    /// Notes the box of the same point, or the box of all points with this radius.
    void note_box(Part end, double radius, const Box& box) {
        const bool is_great = radius > of(end) / 2;
        double* reach = &numbers_[end * width() + (is_great ? 0 : 1 + 2 * dimension_)];
        raise(*reach, radius);
        for (int a = 0; a < dimension_; ++a) {
            raise(*++reach, -box.lower[a]);
            raise(*++reach, box.upper[a]);
        }
    }

    /// Returns the numbers of all parts. The ranks have to take the maximum of each.
    std::span<double> numbers() { return numbers_; }

    /// Returns the numbers of one part.
    std::span<double> numbers_of(Part end) {
        return std::span(numbers_).subspan(end * width(), width());
    }

    double of(Part end) const { return numbers_[end * width()]; }
    double greatest() const {
        double greatest = -infinity;
        for (std::size_t k = 0; k < numbers_.size(); k += width())
            greatest = std::max(greatest, numbers_[k]);
        return greatest;
    }

    /// Returns true if the centre of a ball is within a reach of the part, or if the ball touches a
    /// box of the part's points.
    bool reaches(Part end, const Ball& ball) const {
        const double* great = &numbers_[end * width()];
        return reaches_from(great, ball) ||
               reaches_from(great + 1 + std::size_t{2} * dimension_, ball);
    }

  private:
    std::size_t width() const { return 2 + 4 * static_cast<std::size_t>(dimension_); }
    static void raise(double& number, double to) { number = std::max(number, to); }

    bool reaches_from(const double* reach, const Ball& ball) const {
        Box box;
        for (int a = 0; a < dimension_; ++a) {
            box.lower[a] = -reach[1 + 2 * a];
            box.upper[a] = reach[2 + 2 * a];
        }
        return ball.touches(box, Ball::reach_of(*reach), dimension_);
    }

    int dimension_;
    std::vector<double> numbers_;  ///< for each part and each of its two reaches: the reach, and a
                                   ///< box whose lower ends are negated
};

}  // namespace rrcb
