#pragma once

#include <rrcb/experimental/cost.hpp>

#include <mpi.h>
#include <mpm/decomposition.hpp>
#include <mpm/particles.hpp>
#include <mpm/scene.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mpm {

/// Sums over all points. In two dimensions all except `num_points` are per metre of depth.
struct Totals {
    std::int64_t num_points = 0;    ///< points that are still in the domain
    double mass = 0;                ///< kg
    Vector center{};                ///< centre of mass, m
    Vector momentum{};              ///< kg m/s
    double kinetic_energy = 0;      ///< J
    double strain_energy = 0;       ///< stored elastic energy, J
    double potential_energy = 0;    ///< in gravity at its full strength, J; 0 at the origin
    std::int64_t num_migrated = 0;  ///< changes of rank since the start, with those of rebalances
    std::int64_t num_ghost_nodes = 0;  ///< sum over the ranks of the nodes that each sent in the
                                       ///< last step
};

/// Advances a scene in time on all ranks of a communicator.
///
/// Construction, destruction, `step` and `rebalance` are collective. A rank may have no points. The
/// simulation uses a duplicate of the communicator. Results for any number of ranks and any
/// decomposition agree up to round-off; with the same ranks and decomposition they are
/// bit-identical. Every failure throws on all ranks: std::invalid_argument for a wrong scene, else
/// std::runtime_error.
class Simulation {
  public:
    /// Creates the points of the scene. The first decomposition is `slabs` of their extent.
    Simulation(const Scene& scene, MPI_Comm comm);
    /// Continues from a file that write_state has written for the same scene. Rank 0 reads it.
    ///
    /// On the same number of ranks the points are divided as in the file, and the results are
    /// bit-identical to those of a run without interruption. On another number of ranks the first
    /// decomposition is `slabs`. Migrations are counted from here on.
    Simulation(const Scene& scene, const std::string& state, MPI_Comm comm);
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Advances by time_step(). Points that cross an open side of the domain are removed.
    void step();

    /// Requests a new decomposition from the balancer and moves the points to their new owners.
    /// Returns how many points have left this rank.
    ///
    /// Throws if the decomposition does not have one box per rank, or if a point is not in its
    /// owner's box.
    std::size_t rebalance(const Balancer& balancer);

    /// Returns whether a rebalance before the next step pays. rrcb::Controller finds that from the
    /// steps and rebalances so far. The result is the same on all ranks.
    bool due() const;
    /// Learns from now on what points cost, by work_columns(). Collective; call it before the first
    /// step. The returned model has the weights for the balancer.
    rrcb::experimental::CostModel& learn_costs();

    /// Writes the complete state of the simulation to a file. Collective; rank 0 writes. Numbers
    /// have the byte order of the machine.
    void write_state(const std::string& path) const;

    double time() const;       ///< s
    double time_step() const;  ///< length of the next step, s
    std::int64_t step_count() const;
    std::int64_t num_points() const;  ///< on all ranks at the start
    /// Returns the speed from which time_step() is computed, m/s: that of the fastest point or node
    /// in the step before the last one, because the reduction overlaps with a step.
    double max_speed() const;
    /// Returns the processor time that this rank has spent on its own nodes and points in the last
    /// step, s. It excludes communication, which includes waiting for other ranks.
    double work_seconds() const;

    /// Returns the quantities that determine this rank's work in the last step: the number of
    /// points, of runs (sequences of consecutive points that reach the same nodes), of nodes around
    /// its points, and of nodes sent to other ranks.
    std::vector<double> work_columns() const;
    /// Returns the share of each of this rank's points in work_columns(), one row per point. The
    /// share in the nodes sent to other ranks is 0.
    std::vector<double> point_columns() const;

    /// Returns the points of this rank. Columns have names like "x" and "velocity_x".
    const Particles& particles() const;
    Positions positions() const;  ///< positions of this rank's points
    /// Returns the displacement of each of this rank's points since the start, m.
    std::vector<Vector> displacements() const;
    /// Returns the largest x of those of this rank's points that have moved by more than `way` m
    /// since the start, m, or -infinity if there are none.
    double front_x(double way) const;
    const Decomposition& decomposition() const;

    /// Returns the names of the kernels of a step, in their order and including communication.
    std::vector<std::string> kernels() const;
    /// Returns the number of doubles that a message contains for each shared node.
    std::size_t doubles_per_ghost_node() const;
    /// Returns the numbers that effects report, with their names, for example the position of a
    /// rigid body. They are the same on all ranks.
    std::vector<std::pair<std::string, double>> reports() const;
    /// Returns sums over the points of all ranks. Collective.
    Totals totals() const;

    /// Interface of the implementations for two and three dimensions. Private to the library.
    class Model;

  private:
    std::unique_ptr<Model> model_;
};

}  // namespace mpm
