#include "step/stepper.hpp"

namespace mpm {

namespace {

/// The sums of one rank. All are doubles, so that one reduction adds them.
struct Sums {
    double num_points = 0, mass = 0, kinetic_energy = 0, strain_energy = 0, num_sent = 0,
           num_ghost_nodes = 0;
    Vector moment{}, momentum{};
};

template <typename Kernels>
void append_names(const Kernels& kernels, std::vector<std::string>& names) {
    for (const auto& kernel : kernels) names.push_back(kernel.name);
}

}  // namespace

template <int D>
std::vector<std::string> Stepper<D>::kernels() const {
    std::vector<std::string> names;
    const auto append_transfer = [&](const std::string& name) {
        names.push_back(name);
        if (stages_.volume_change == VolumeChange::shared) names.push_back("locking_cure");
    };
    append_transfer("p2g");
    append_names(stages_.fields, names);
    append_names(stages_.scatters, names);
    names.push_back("ghost_nodes");
    append_names(stages_.forces, names);
    append_names(stages_.constraints, names);
    names.push_back("move_nodes");
    append_names(stages_.moved, names);
    append_transfer("g2p");
    for (const MaterialModel<D>& material : materials_) append_names(material.kernels, names);
    append_names(stages_.after_materials, names);
    append_names(stages_.ends, names);
    names.push_back("migrate");
    return names;
}

template <int D>
Totals Stepper<D>::totals() const {
    Sums sums;
    sums.num_points = static_cast<double>(particles.size());
    for (std::size_t p = 0; p < particles.size(); ++p) {
        const double mass = particles[motion_.mass][p];
        sums.mass += mass;
        for (std::size_t a = 0; a < D; ++a) {
            const double velocity = particles[motion_.velocity[a]][p];
            sums.moment[a] += mass * particles[motion_.position[a]][p];
            sums.momentum[a] += mass * velocity;
            sums.kinetic_energy += 0.5 * mass * velocity * velocity;
        }
        const double material = material_column_ ? particles[*material_column_][p] : 0;
        sums.strain_energy +=
            materials_[static_cast<std::size_t>(material)].strain_energy(particles, p);
    }
    sums.num_sent = static_cast<double>(num_sent);
    sums.num_ghost_nodes = static_cast<double>(ghosts_->num_shared());
    MPI_Allreduce(MPI_IN_PLACE, &sums, sizeof sums / sizeof(double), MPI_DOUBLE, MPI_SUM, comm_);
    Totals totals{.num_points = static_cast<std::int64_t>(sums.num_points),
                  .mass = sums.mass,
                  .momentum = sums.momentum,
                  .kinetic_energy = sums.kinetic_energy,
                  .strain_energy = sums.strain_energy,
                  .num_migrated = static_cast<std::int64_t>(sums.num_sent),
                  .num_ghost_nodes = static_cast<std::int64_t>(sums.num_ghost_nodes)};
    for (std::size_t a = 0; a < D; ++a) {
        if (sums.mass > 0) totals.center[a] = sums.moment[a] / sums.mass;
        if (stages_.gravity)
            totals.potential_energy -= stages_.gravity->acceleration[a] * sums.moment[a];
    }
    return totals;
}

template <int D>
std::vector<std::pair<std::string, double>> Stepper<D>::reports() const {
    std::vector<std::pair<std::string, double>> reports;
    for (const Report& report : stages_.reports) reports.emplace_back(report.name, report.value());
    return reports;
}

template std::vector<std::string> Stepper<2>::kernels() const;
template std::vector<std::string> Stepper<3>::kernels() const;
template Totals Stepper<2>::totals() const;
template Totals Stepper<3>::totals() const;
template std::vector<std::pair<std::string, double>> Stepper<2>::reports() const;
template std::vector<std::pair<std::string, double>> Stepper<3>::reports() const;

}  // namespace mpm
