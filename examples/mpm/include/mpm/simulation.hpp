#pragma once

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

/// Sums over all points. In two dimensions all but `num_points` are per metre of depth.
struct Totals {
    std::int64_t num_points = 0;       ///< that are in the domain
    double mass = 0;                   ///< kg
    Vector center{};                   ///< of mass, m
    Vector momentum{};                 ///< kg m/s
    double kinetic_energy = 0;         ///< J
    double strain_energy = 0;          ///< elastic, J
    double potential_energy = 0;       ///< of gravity at its full strength, J; 0 at the origin
    std::int64_t num_migrated = 0;     ///< changes of rank since the start, rebalances included
    std::int64_t num_ghost_nodes = 0;  ///< nodes that a rank sent in the last step, of all ranks
};

/// A scene, advanced in time by all ranks of a communicator.
///
/// Construction, destruction, `step` and `rebalance` are collective; ranks may hold no points.
/// It works on its own duplicate of the communicator. Results are the same on any number of ranks
/// and decomposition to round-off, and repeat to the bit on the same ones.
/// Every failure throws std::runtime_error (std::invalid_argument for the scene) on all ranks.
class Simulation {
  public:
    /// Places the points of the scene; the first decomposition is `slabs` of their extent.
    Simulation(const Scene& scene, MPI_Comm comm);
    /// Goes on from a file that write_state has written of the same scene. Rank 0 reads.
    ///
    /// On as many ranks as wrote it the points are divided as there, and what follows has the same
    /// bits as without the stop; on others they start in `slabs`. Migrations count from here on.
    Simulation(const Scene& scene, const std::string& state, MPI_Comm comm);
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Advances by time_step(). Points that pass an open side of the domain are gone.
    void step();

    /// Asks the balancer for a new decomposition and moves the points to their new owners. Returns
    /// how many have left this rank.
    ///
    /// Throws where it has not one box per rank or a box does not hold the points given to it.
    std::size_t rebalance(const Balancer& balancer);

    /// Writes all that the next steps depend on to a file. Collective; rank 0 writes. Doubles are
    /// in the byte order of the machine.
    void write_state(const std::string& path) const;

    double time() const;       ///< s
    double time_step() const;  ///< of the next step, s
    std::int64_t step_count() const;
    std::int64_t num_points() const;  ///< at the start, over all ranks
    double max_speed() const;         ///< over all points, and nodes in the last step, m/s
    /// Processor time that this rank has spent on its own nodes and points in the last step, s:
    /// without communication, which waits for others.
    double work_seconds() const;

    /// Numbers that the work of the last step grows with, on this rank: points, runs of points that
    /// reach the same nodes one after the other, nodes around its points, nodes sent to other
    /// ranks.
    std::vector<double> work_columns() const;
    /// Parts of this rank's points in these numbers, row after row; 0 of the shared nodes.
    std::vector<double> point_columns() const;

    /// Points of this rank, columns by name, as "x", "velocity_x".
    const Particles& particles() const;
    Positions positions() const;  ///< of this rank's points
    /// How far this rank's points have moved since the start, m.
    std::vector<Vector> displacements() const;
    /// Largest x of this rank's points that have moved by more than `way` m since the start, m;
    /// -infinity where there is none.
    double front_x(double way) const;
    const Decomposition& decomposition() const;

    /// Names of the kernels of a step in their order, communication included.
    std::vector<std::string> kernels() const;
    /// Doubles in a message per shared node.
    std::size_t doubles_per_ghost_node() const;
    /// Numbers that effects report, by name, as the place of a rigid body. The same on all ranks.
    std::vector<std::pair<std::string, double>> reports() const;
    /// Sums over the points of all ranks. Collective.
    Totals totals() const;

    /// A simulation of either dimension. Private to the library.
    class Model;

  private:
    std::unique_ptr<Model> model_;
};

}  // namespace mpm
