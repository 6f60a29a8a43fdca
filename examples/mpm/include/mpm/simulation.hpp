#pragma once

#include <mpi.h>
#include <mpm/decomposition.hpp>
#include <mpm/particles.hpp>
#include <mpm/scene.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace mpm {

struct RebalanceReport {
    std::int64_t moved_points = 0;  ///< over all ranks
};

/// A scene, advanced in time by all ranks of a communicator.
///
/// Construction, destruction, `step` and `rebalance` are collective; ranks may hold no points.
/// It works on its own duplicate of the communicator. Results do not depend on the number of
/// ranks or the decomposition beyond round-off, and repeat to the bit on the same ones.
/// Every failure throws std::runtime_error (std::invalid_argument for the scene) on all ranks.
class Simulation {
  public:
    /// Places the points of the scene; the first decomposition is `slabs` of their extent.
    Simulation(const Scene& scene, MPI_Comm comm);
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Advances by time_step(); throws when a point has left the grid.
    void step();

    /// Asks the balancer for a new decomposition and moves the points to their new owners.
    /// Throws when it has not one box per rank or a box does not hold the points given to it.
    RebalanceReport rebalance(const Balancer& balancer);

    double time() const;       ///< s
    double time_step() const;  ///< of the next step, s
    std::int64_t step_count() const;
    std::int64_t num_points() const;  ///< over all ranks
    double max_speed() const;         ///< over all points, m/s

    const Particles& particles()
        const;                    ///< of this rank; columns by name, as "x", "displacement_x"
    Positions positions() const;  ///< of this rank's points
    const Decomposition& decomposition() const;

    /// Names of the kernels of a step in their order, the communication among them.
    std::vector<std::string> kernels() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace mpm
