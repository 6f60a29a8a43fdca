#pragma once

#include <rrcb/cuts.hpp>

#include <mpi.h>

#include <span>
#include <vector>

namespace rrcb::zoltan {

/// AVERAGE_CUTS: every cut halfway between the nearest objects on both sides of it, which stay
/// where they are.
///
/// A cut between objects with the same coordinate, which other coordinates tell apart, stays, and
/// so does one with no objects on a side.
class CutAverage {
  public:
    /// Room for the cuts between so many parts; to be agreed on before run(). Not collective.
    explicit CutAverage(std::size_t num_parts) : boxes_(num_parts), gaps_(num_parts - 1) {}

    /// Moves the cuts by which the points got their `parts`. Collective: one reduction.
    void run(const Points& points, std::span<const Part> parts, MPI_Comm comm, Cuts& cuts);

  private:
    /// Between the sides of a cut, along its axis; the lower one is the maximum of what lies below,
    /// the upper one, as its negative, of what lies above.
    struct Gap {
        double lower;
        double minus_upper;
    };

    std::vector<Box> boxes_;  ///< of the points in each part
    std::vector<Gap> gaps_;   ///< of each cut
};

}  // namespace rrcb::zoltan
