#pragma once

#include "arithmetic/running_sums.hpp"
#include "cuts/packed_tree.hpp"

#include <rrcb/points.hpp>

#include <array>
#include <span>
#include <vector>

namespace rrcb {

class PeriodicImages;

/// Boxes of this rank, shrunk by a radius. If a point is in one of them, a ball of at most that
/// radius around it touches no region of another rank, and no image of the point is within the
/// radius of the periodic box.
///
/// Most points are in these boxes, which is found with a few comparisons of their coordinates.
class QuietBoxes {
  public:
    /// Takes boxes in which only this rank holds parts, see NearBoxes::homes(), and the largest
    /// radius. A negative radius means that no other rank is near. `images` may be null.
    QuietBoxes(std::span<const Box> homes, double radius, int dimension,
               const PeriodicImages* images = nullptr);

    /// Calls visit(i) for each point that is in none of the boxes, in ascending order.
    template <class Visit>
    void for_each_outside(const Points& points, Visit&& visit) const {
        std::array<LocalIndex, block_length> outside;
        in_ranges(points.count, block_length, [&](LocalIndex first, LocalIndex last) {
            const LocalIndex number = list_outside(points, first, last, outside.data());
            for (LocalIndex k = 0; k < number; ++k) visit(outside[k]);
        });
    }

  private:
    /// Writes the points from `first` to `last` - 1 that are in none of the boxes. Returns their
    /// number.
    LocalIndex list_outside(const Points& points, LocalIndex first, LocalIndex last,
                            LocalIndex* outside) const;

    std::vector<Box> boxes_;  ///< without their faces
};

}  // namespace rrcb
