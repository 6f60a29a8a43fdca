#include "step/stepper.hpp"

namespace mpm {

namespace {

/// Sums of one rank, all of them doubles: one reduction adds them.
struct Sums {
    double mass = 0, kinetic_energy = 0, strain_energy = 0, dissipated_energy = 0;
    double transfer_loss = 0, num_sent = 0;
    double num_ghost_nodes = 0;
    Vector moment{}, momentum{};
};

template <typename Kernels>
void append_names(const Kernels& kernels, std::vector<std::string>& names) {
    for (const auto& kernel : kernels) names.push_back(kernel.name);
}

}  // namespace

template <int D>
std::vector<std::string> Stepper<D>::kernels() const {
    std::vector<std::string> names{"p2g"};
    append_names(stages_.fields, names);
    append_names(stages_.scatters, names);
    names.push_back("ghost_nodes");
    append_names(stages_.forces, names);
    append_names(stages_.constraints, names);
    names.push_back("move_nodes");
    append_names(stages_.moved, names);
    names.push_back("g2p");
    append_names(stages_.gradients, names);
    append_names(stages_.before_materials, names);
    for (const MaterialModel<D>& material : materials_) append_names(material.kernels, names);
    append_names(stages_.after_materials, names);
    append_names(stages_.ends, names);
    names.push_back("migrate");
    return names;
}

template <int D>
double Stepper<D>::strain_energy(std::size_t point) const {
    const std::size_t material =
        material_column_ ? static_cast<std::size_t>(particles[*material_column_][point]) : 0;
    return materials_[material].strain_energy(particles, point);
}

/// Starts the points. The energy that they hold from the start is no loss.
template <int D>
void Stepper<D>::start_points() {
    for (const auto& prepare : stages_.preparations) prepare(particles);
    if (stages_.preparations.empty() || !stages_.work) return;
    for (std::size_t p = 0; p < particles.size(); ++p)
        particles.data(stages_.work->internal)[p] = strain_energy(p);
}

template <int D>
Totals Stepper<D>::totals() const {
    Sums sums;
    for (std::size_t p = 0; p < particles.size(); ++p) {
        const double mass = particles[motion_.mass][p];
        sums.mass += mass;
        for (std::size_t a = 0; a < D; ++a) {
            const double velocity = particles[motion_.velocity[a]][p];
            sums.moment[a] += mass * particles[motion_.position[a]][p];
            sums.momentum[a] += mass * velocity;
            sums.kinetic_energy += 0.5 * mass * velocity * velocity;
        }
        sums.strain_energy += strain_energy(p);
    }
    for (std::size_t p = 0; stages_.work && p < particles.size(); ++p) {
        const double plastic = particles[stages_.work->plastic][p];
        sums.dissipated_energy += plastic;
        sums.transfer_loss += particles[stages_.work->internal][p] - plastic;
    }
    if (stages_.work) sums.transfer_loss -= sums.strain_energy;
    for (const auto& dissipated : stages_.dissipated)
        sums.dissipated_energy += dissipated(particles);
    if (stages_.transfer_loss) sums.transfer_loss += stages_.transfer_loss(particles);
    sums.num_sent = static_cast<double>(num_sent);
    sums.num_ghost_nodes = static_cast<double>(ghosts_->num_shared());
    MPI_Allreduce(MPI_IN_PLACE, &sums, sizeof sums / sizeof(double), MPI_DOUBLE, MPI_SUM, comm_);
    Totals totals{.num_points = num_points,
                  .mass = sums.mass,
                  .momentum = sums.momentum,
                  .kinetic_energy = sums.kinetic_energy,
                  .strain_energy = sums.strain_energy,
                  .num_migrated = static_cast<std::int64_t>(sums.num_sent),
                  .num_ghost_nodes = static_cast<std::int64_t>(sums.num_ghost_nodes)};
    if (stages_.work) totals.dissipated_energy = sums.dissipated_energy;
    if (stages_.transfer_loss) totals.transfer_loss = sums.transfer_loss;
    for (std::size_t a = 0; a < D; ++a) {
        totals.center[a] = sums.moment[a] / sums.mass;
        if (stages_.gravity)
            totals.potential_energy -= stages_.gravity->acceleration[a] * sums.moment[a];
    }
    for (const auto& energy_of : stages_.rigid_energies) {
        const RigidEnergy energy = energy_of();
        totals.kinetic_energy += energy.kinetic;
        totals.potential_energy += energy.potential;
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
template void Stepper<2>::start_points();
template void Stepper<3>::start_points();
template double Stepper<2>::strain_energy(std::size_t) const;
template double Stepper<3>::strain_energy(std::size_t) const;
template Totals Stepper<2>::totals() const;
template Totals Stepper<3>::totals() const;
template std::vector<std::pair<std::string, double>> Stepper<2>::reports() const;
template std::vector<std::pair<std::string, double>> Stepper<3>::reports() const;

}  // namespace mpm
