#pragma once

#include <rrcb/cuts.hpp>

#include <mpi.h>

#include <span>
#include <vector>

namespace rrcb::zoltan {

/// AVERAGE_CUTS: every cut halfway between the nearest objects on both sides of it. Objects keep
/// their parts.
///
/// A cut stays where objects on both sides share its coordinate and differ in others. It stays
/// where a side has no objects.
class CutAverage {
  public:
    /// Makes room for the cuts between so many parts. Throws std::bad_alloc, which all ranks must
    /// agree on before run(). Not collective.
    explicit CutAverage(std::size_t num_parts) : boxes_(num_parts), gaps_(num_parts - 1) {}

    /// Moves the cuts by which the points got their `parts`. Collective: one reduction.
    void run(const Points& points, std::span<const Part> parts, MPI_Comm comm, Cuts& cuts);

  private:
    /// Gap between the points on both sides of a cut, along its axis: the greatest coordinate
    /// below, and the negative of the least one above. So one maximum over the ranks reduces both.
    struct Gap {
        double lower;
        double minus_upper;
    };

    std::vector<Box> boxes_;  ///< of the points in each part
    std::vector<Gap> gaps_;   ///< of each cut
};

}  // namespace rrcb::zoltan
