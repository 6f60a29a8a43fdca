#pragma once

#include "particles.hpp"

#include <rrcb/rrcb.hpp>

#include <mpi.h>

#include <array>
#include <cstdint>

namespace comparisons {

/// Random points in a box that consists of as many unit cubes as there are ranks. The points jump
/// at random, so that 1 % of them leave their rank in each step. Ghosts are needed within two
/// spacings.
///
/// A jump depends only on the numbers of the point and of the step. The points are therefore the
/// same for every arm.
class Flow {
  public:
    /// Balances the points. Collective. `comm` must outlive it.
    Flow(int dimension, std::int64_t points_per_rank, MPI_Comm comm);

    const rrcb::Cuts& cuts() const { return cuts_; }
    MPI_Comm comm() const { return comm_; }
    int rank() const { return rank_; }
    int num_ranks() const { return cuts_.num_parts; }
    int dimension() const { return start_.dimension; }
    double radius() const { return radius_; }
    /// Returns the largest length of a jump along an axis.
    double travel() const { return travel_; }
    /// Returns the points of this rank after the balance.
    const Particles& start() const { return start_; }

    /// Moves the points of this rank. They are reflected at the sides of the box. Not collective.
    void move(Particles& particles, int step) const;

    /// Moves the first point to the upper corner of the box. Not collective.
    void jump(Particles& particles) const;

    /// Writes forces on points and ghosts. They depend on the positions and on this rank. Not
    /// collective.
    void push(Particles& particles) const;

  private:
    rrcb::Cuts cuts_{};
    MPI_Comm comm_;
    int rank_ = 0;
    std::array<int, 3> cubes_{};
    double radius_;
    double travel_ = 0;
    Particles start_{};
};

}  // namespace comparisons
