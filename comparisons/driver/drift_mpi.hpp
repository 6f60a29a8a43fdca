#pragma once

#include "workload_mpi.hpp"

#include <mpi.h>

#include <cstdint>

namespace comparisons {

/// A steady wind through the box of a workload: between two calls each point moves by a fraction of
/// the extents, in a direction that turns with its position.
class Drift {
  public:
    /// Takes the box of all points as they are. Collective over `comm`.
    Drift(const Workload& workload, double fraction, std::uint64_t seed, MPI_Comm comm);

    /// Moves the points; nothing where the fraction is 0. Not collective: where a point goes
    /// follows from its position and the seed alone.
    void move(Workload& workload) const;

    bool moves() const { return fraction_ > 0; }

  private:
    rrcb::Vector direction_at(const rrcb::Vector& place) const;

    double fraction_;
    int dimension_;
    rrcb::Box box_;
    double phase_;          ///< of the direction, 0 ... 1
    rrcb::Vector turns_{};  ///< of it from one end of each axis to the other
};

}  // namespace comparisons
