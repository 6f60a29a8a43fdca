#pragma once

#include "parallel/migration_mpi.hpp"

#include <mpi.h>
#include <mpm/decomposition.hpp>
#include <mpm/scene.hpp>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace mpm {

/// The values that the ranks agree on after points have moved or a balancer has divided them.
struct Agreement {
    Reach reach = Reach::nowhere;
    double max_speed = 0;  ///< m/s
};

/// Finds the points that belong to other ranks, and makes all ranks agree on how to move them.
class Ownership {
  public:
    /// Points that cross an open side leave the grid. The other sides reflect them.
    Ownership(const GridShape& grid, const Walls& walls, MPI_Comm comm);

    /// Finds the points that have left this rank's box. Not collective.
    ///
    /// A point that has crossed a closed side in the step is moved to its mirror image.
    /// has_outgrown() is set if a point of this rank is outside `home`, a part of this rank's box.
    /// `now` is the time for the message about a point whose position is not finite.
    template <int D>
    void find_leavers(const Decomposition& decomposition, const Box& home, Particles& particles,
                      const MotionColumns& motion, double now, std::span<const int> neighbours);

    /// Finds the points that a new decomposition assigns to other ranks. Not collective.
    ///
    /// A rank that no point leaves reads each position once. `neighbours` are those of migrate().
    void find_reassigned(const Decomposition& next, Positions positions,
                         std::span<const int> neighbours);

    /// Returns the largest reach and speed of all ranks. Collective. Throws std::runtime_error on
    /// all ranks if any has found a fault since the last agreement.
    Agreement agree(double speed);

    const Leavers& leavers() const { return leavers_; }
    bool has_outgrown() const { return has_outgrown_; }

  private:
    /// Faults that a rank has found, the most serious one last.
    enum class Fault { none, misplaced, no_owner, not_finite };

    [[noreturn]] void throw_fault(Fault fault, bool is_mine);
    void report(Fault fault);
    template <int D>
    void find_outside(const Box& box, const Box& home, Particles& particles,
                      const MotionColumns& motion, double now);
    template <int D>
    bool stays(Particles& particles, const MotionColumns& motion, std::size_t p) const;
    bool ask_owners(const Decomposition& decomposition, Positions positions);
    void check_owner(const Decomposition& decomposition, int owner, Positions positions,
                     std::size_t point);
    template <int D>
    void take_owners(const Decomposition& decomposition, std::span<const int> owners,
                     Positions positions);
    void measure_reach(std::span<const int> neighbours);

    MPI_Comm comm_;
    int rank_;
    std::size_t num_ranks_;
    Box grid_;
    std::array<std::array<bool, 2>, 3> is_open_;  ///< by axis, for the lower and the upper side
    Leavers leavers_;
    bool has_outgrown_ = false;
    std::array<std::vector<double>, 3> at_;  ///< positions of the leavers
    std::vector<int> owners_;
    Reach reach_ = Reach::nowhere;
    Fault fault_ = Fault::none;
    std::string lost_;  ///< error message about a point whose position is not finite
};

}  // namespace mpm
