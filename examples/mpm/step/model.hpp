#pragma once

#include <mpm/simulation.hpp>

namespace mpm {

/// A simulation whose dimension is not known; every call is one of a step, never of a point.
class Simulation::Model {
  public:
    virtual ~Model() = default;
    virtual void step() = 0;
    virtual RebalanceReport rebalance(const Balancer& balancer) = 0;
    virtual std::vector<std::string> kernels() const = 0;
    virtual std::size_t doubles_per_ghost_node() const = 0;
    virtual Totals totals() const = 0;
    virtual std::vector<std::pair<std::string, double>> reports() const = 0;
    virtual Positions positions() const = 0;

    Particles particles;
    Decomposition decomposition;
    std::int64_t num_points = 0, num_steps = 0;
    std::int64_t num_sent = 0;  ///< by this rank
    double time = 0, time_step = 0, max_speed = 0;
};

/// Collective; the scene must be valid and hold points.
std::unique_ptr<Simulation::Model> make_model(const Scene& scene, MPI_Comm comm);

}  // namespace mpm
