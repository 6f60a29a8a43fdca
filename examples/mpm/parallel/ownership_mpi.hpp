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

/// Agreement of the ranks after points have moved or a balancer has divided them.
struct Agreement {
    Reach reach = Reach::nowhere;
    double max_speed = 0;  ///< m/s
};

/// Finds the points that belong to other ranks, and makes all ranks agree on what follows.
class Ownership {
  public:
    /// Points beyond the grid leave it through the open walls; others return them.
    Ownership(const GridShape& grid, const Walls& walls, MPI_Comm comm);

    /// Finds the points that have left this rank's box. Not collective.
    ///
    /// A point that a step has carried beyond a closed side is put back where a mirror would have
    /// sent it. Sets has_outgrown() if one that stays is outside `home`, a part of this rank's box.
    /// `now` is for the message about one whose position is not finite.
    template <int D>
    void find_leavers(const Decomposition& decomposition, const Box& home, Particles& particles,
                      const MotionColumns& motion, double now, std::span<const int> neighbours);

    /// Finds the points that a new decomposition gives to other ranks. Not collective.
    ///
    /// Ranks that no point leaves touch each point's position once. `neighbours` are those of
    /// migrate().
    void find_reassigned(const Decomposition& next, Positions positions,
                         std::span<const int> neighbours);

    /// Largest reach and speed over the ranks. Collective. Throws std::runtime_error on all ranks
    /// where one has found a fault since the last agreement.
    Agreement agree(double speed);

    const Leavers& leavers() const { return leavers_; }
    bool has_outgrown() const { return has_outgrown_; }

  private:
    /// Faults of a rank, in ascending order of gravity.
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
    std::array<std::array<bool, 2>, 3> is_open_;  ///< by axis: the lower and the upper side
    Leavers leavers_;
    bool has_outgrown_ = false;
    std::array<std::vector<double>, 3> at_;  ///< positions of the leavers
    std::vector<int> owners_;
    Reach reach_ = Reach::nowhere;
    Fault fault_ = Fault::none;
    std::string lost_;  ///< text about a point whose position is not finite
};

}  // namespace mpm
