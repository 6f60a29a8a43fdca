#pragma once

#include "arithmetic/infinity.hpp"
#include "lists/ball.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace rrcb {

/// Distances within which the points of each part need others.
///
/// Each part has two: the greatest radius, from the box of its points with more than half of it,
/// and the greatest of the other radii, from the box of these. Numbered as the ends of the tree.
class PartReaches {
  public:
    /// Throws std::bad_alloc. No part needs points so far.
    PartReaches(int num_parts, int dimension)
        : dimension_(dimension), numbers_(num_parts * width(), -infinity) {}

    /// Notes a radius of this rank, before all places.
    void note_radius(Part end, double radius) { raise(numbers_[end * width()], radius); }

    /// Notes the box of the same point, or of all points with this radius.
    void note_box(Part end, double radius, const Box& box) {
        const bool is_great = radius > of(end) / 2;
        double* reach = &numbers_[end * width() + (is_great ? 0 : 1 + 2 * dimension_)];
        raise(*reach, radius);
        for (int a = 0; a < dimension_; ++a) {
            raise(*++reach, -box.lower[a]);
            raise(*++reach, box.upper[a]);
        }
    }

    /// Returns the numbers of all parts, of which the ranks take the maximum.
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

    /// Returns true if a part needs the centre of a ball, or the ball touches a box of its points.
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
    std::vector<double>
        numbers_;  ///< of each part: twice a reach and a box, its lower ends negated
};

}  // namespace rrcb
