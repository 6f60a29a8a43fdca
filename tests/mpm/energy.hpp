#pragma once

#include "support.hpp"

#include <array>
#include <vector>

namespace mpm::test {

/// Energy of a simulation from step to step. Stresses belong to the end of a step and velocities to
/// its middle: the kinetic energy at the end is the product of the velocities before and after it.
class Energy {
  public:
    explicit Energy(const Simulation& simulation)
        : simulation_(simulation), dimension_(simulation.positions().dimension) {
        const Totals totals = simulation.totals();
        stored_ = totals.strain_energy + totals.potential_energy;
        const auto ids = simulation.particles()["id"];
        velocities_.resize(static_cast<std::size_t>(*std::ranges::max_element(ids)) + 1);
        for (std::size_t p = 0; p < ids.size(); ++p)
            velocities_[static_cast<std::size_t>(ids[p])] = velocity_of(p);
    }

    /// Energy at the construction, once a step has been made since, J.
    double before_the_step() const {
        const auto ids = simulation_.particles()["id"], mass = simulation_.particles()["mass"];
        double kinetic = 0;
        for (std::size_t p = 0; p < ids.size(); ++p) {
            const Vector before = velocities_[static_cast<std::size_t>(ids[p])];
            const Vector after = velocity_of(p);
            for (std::size_t a = 0; a < 3; ++a) kinetic += 0.5 * mass[p] * before[a] * after[a];
        }
        return kinetic + stored_;
    }

  private:
    Vector velocity_of(std::size_t p) const {
        Vector velocity{};
        for (std::size_t a = 0; a < static_cast<std::size_t>(dimension_); ++a)
            velocity[a] = simulation_.particles()[std::string("velocity_") + "xyz"[a]][p];
        return velocity;
    }

    const Simulation& simulation_;
    int dimension_;
    double stored_ = 0;
    std::vector<Vector> velocities_;
};

}  // namespace mpm::test
