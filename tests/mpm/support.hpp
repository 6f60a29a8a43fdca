#pragma once

#include "../support/common.hpp"
#include "parallel/communicator_mpi.hpp"
#include "slope.hpp"

#include <mpm/region.hpp>
#include <mpm/simulation.hpp>

#include <numbers>

namespace mpm::test {

/// Parameters of a scene's effect; null if the scene does not name it.
inline Parameters* find_effect(Scene& scene, const std::string& name) {
    for (Effect& effect : scene.effects)
        if (effect.name == name) return &effect.parameters;
    return nullptr;
}

/// How far this rank's points have moved along an axis, m.
inline std::vector<double> displacements_along(const Simulation& simulation, std::size_t axis) {
    std::vector<double> along;
    for (const Vector& displacement : simulation.displacements())
        along.push_back(displacement[axis]);
    return along;
}

/// Numbers of all ranks in ascending order, on every rank.
inline std::vector<double> sorted_over_ranks(std::span<const double> numbers, MPI_Comm comm) {
    const auto count = static_cast<int>(numbers.size());
    std::vector<int> counts(static_cast<std::size_t>(size_of(comm))), starts(counts.size());
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
    std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
    std::vector<double> all(static_cast<std::size_t>(starts.back() + counts.back()));
    MPI_Allgatherv(numbers.data(), count, MPI_DOUBLE, all.data(), counts.data(), starts.data(),
                   MPI_DOUBLE, comm);
    std::ranges::sort(all);
    return all;
}

/// A column of all points, or "displacement_x" ..., in the order of their ids, on every rank.
/// Exact: ids have one owner.
inline std::vector<double> gathered(const Simulation& simulation, const std::string& column,
                                    MPI_Comm comm) {
    const auto ids = simulation.particles()["id"];
    const std::vector<double> all = sorted_over_ranks(ids, comm);
    std::vector<double> values(all.size(), 0.0);
    const bool is_way = column.starts_with("displacement_");
    const auto along =
        displacements_along(simulation, is_way ? static_cast<std::size_t>(column.back() - 'x') : 0);
    const std::span<const double> local = is_way ? along : simulation.particles()[column];
    for (std::size_t p = 0; p < ids.size(); ++p)
        values[static_cast<std::size_t>(std::ranges::lower_bound(all, ids[p]) - all.begin())] =
            local[p];
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                  comm);
    return values;
}

/// Sum of a function of each point over all ranks.
inline double summed(const Simulation& simulation, MPI_Comm comm,
                     const std::function<double(std::size_t)>& value) {
    double total = 0;
    for (std::size_t p = 0; p < simulation.particles().size(); ++p) total += value(p);
    MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_DOUBLE, MPI_SUM, comm);
    return total;
}

/// Kinetic, strain and potential energy of all points.
inline double total_energy(const Simulation& simulation) {
    const Totals totals = simulation.totals();
    return totals.kinetic_energy + totals.strain_energy + totals.potential_energy;
}

/// What an effect of a simulation tells by this name.
inline double report(const Simulation& simulation, const std::string& name) {
    for (const auto& [key, value] : simulation.reports())
        if (key == name) return value;
    return std::numeric_limits<double>::quiet_NaN();
}

/// Largest difference of two columns by the largest entry of the first.
inline double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double difference = a.size() == b.size() ? 0 : std::numeric_limits<double>::infinity();
    double largest = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        difference = std::max(difference, std::abs(a[i] - b[i]));
        largest = std::max(largest, std::abs(a[i]));
    }
    return difference / largest;
}

/// Boxes between vertical cuts (ascending, one less than ranks); points on a cut go up or down.
inline Decomposition between_cuts(const std::vector<double>& cuts, bool ties_go_up = true) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Decomposition decomposition;
    decomposition.boxes.assign(cuts.size() + 1,
                               {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}});
    for (std::size_t k = 0; k < cuts.size(); ++k) {
        decomposition.boxes[k].upper[0] = cuts[k];
        decomposition.boxes[k + 1].lower[0] = cuts[k];
    }
    decomposition.owners = [cuts, ties_go_up](Positions at, std::span<int> owners) {
        for (std::size_t i = 0; i < owners.size(); ++i) {
            const auto cut = ties_go_up ? std::ranges::upper_bound(cuts, at.x[i])
                                        : std::ranges::lower_bound(cuts, at.x[i]);
            owners[i] = static_cast<int>(cut - cuts.begin());
        }
    };
    return decomposition;
}

/// Boxes between horizontal cuts, as near to the bottom as a cell.
inline Decomposition layers(int num_ranks) {
    Decomposition decomposition = between_cuts(std::vector<double>(num_ranks - 1, 0.0));
    std::vector<double> cuts;
    for (int k = 1; k < num_ranks; ++k) cuts.push_back(0.11 * k);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < decomposition.boxes.size(); ++k) {
        Box& box = decomposition.boxes[k];
        box.lower = {-infinity, k == 0 ? -infinity : cuts[k - 1], -infinity};
        box.upper = {infinity, k < cuts.size() ? cuts[k] : infinity, infinity};
    }
    decomposition.owners = [cuts](Positions at, std::span<int> owners) {
        for (std::size_t i = 0; i < owners.size(); ++i)
            owners[i] = static_cast<int>(std::ranges::upper_bound(cuts, at.y[i]) - cuts.begin());
    };
    return decomposition;
}

/// Expects the positions and velocities of a run on each rank alone and of one on all ranks to
/// agree.
inline void expect_same_motion(const Simulation& serial, const Simulation& parallel) {
    for (const char* column : {"x", "y", "velocity_x", "velocity_y"})
        EXPECT_LT(relative_difference(gathered(serial, column, MPI_COMM_SELF),
                                      gathered(parallel, column, MPI_COMM_WORLD)),
                  1e-11)
            << column;
}

/// An elastic material as a scene names it.
inline Material elastic_material(const std::string& name, double density, double youngs_modulus,
                                 double poissons_ratio) {
    return {name,
            "elastic",
            {{"density", density},
             {"youngs_modulus", youngs_modulus},
             {"poissons_ratio", poissons_ratio}}};
}

/// Soil by Drucker and Prager as a scene names it; Young's modulus 1 MPa, Poisson's ratio 0.3.
inline Material soil_material(const std::string& name, double density, double cohesion,
                              double friction_angle) {
    Material soil = elastic_material(name, density, 1e6, 0.3);
    soil.model = "drucker_prager";
    soil.parameters.insert({{"cohesion", cohesion}, {"friction_angle", friction_angle}});
    return soil;
}

/// Clay by von Mises as a scene names it; Poisson's ratio 0.45.
inline Material clay_material(double youngs_modulus, double strength,
                              double strength_gradient = 0) {
    Material clay = elastic_material("clay", 1600, youngs_modulus, 0.45);
    clay.model = "von_mises";
    clay.parameters["strength"] = strength;
    if (strength_gradient > 0) clay.parameters["strength_gradient"] = strength_gradient;
    return clay;
}

/// Gravity in two dimensions as a scene names it.
inline Effect gravity_effect(double acceleration) {
    return {"gravity", {{"acceleration", std::vector<double>{0, -acceleration}}}};
}

/// Mode 1 of a bar of 25 m held at x = 0: E = 100, density 1, hence wave speed 10 and period
/// 4 L / c = 10; it starts with 0.1 sin(pi x / 2 L).
inline Scene axial_bar() {
    constexpr double length = 25, modulus = 100, amplitude = 0.1;
    return {.name = "bar",
            .grid = {.lower = {0, 0}, .spacing = 1, .num_cells = {28, 1}},
            .materials = {elastic_material("rubber", 1, modulus, 0)},
            .bodies = {{.contains = box_region({{0, 0}, {length, 1}}),
                        .points_per_cell = {2, 2, 1},
                        .material = "rubber",
                        .velocity = velocity_field(
                            {.sine_amplitude = {amplitude, 0},
                             .sine_wave_number = {std::numbers::pi / (2 * length), 0}})}},
            .walls = {.left = Wall::roller, .bottom = Wall::roller, .top = Wall::roller},
            .courant_number = 0.1};
}

/// The slope at a fifth of the paper's resolution, 2,000 points, in full weight at once.
inline Scene coarse_slope() {
    Scene scene = slope_scene(22);
    find_effect(scene, "gravity")->erase("ramp");
    return scene;
}

/// An elastic disk that flies and spins across an open grid of 24 x 10 m.
inline Scene flying_disk() {
    constexpr double centre_x = 4, centre_y = 4, radius = 2;
    const Body disk{
        .contains = ball_region({centre_x, centre_y}, radius),
        .points_per_cell = {3, 3, 1},
        .material = "rubber",
        .velocity = velocity_field(
            {.constant = {8, 1}, .rotation_rate = 1, .rotation_centre = {centre_x, centre_y}})};
    return {.name = "flying disk",
            .grid = {.lower = {0, 0}, .spacing = 0.5, .num_cells = {48, 20}},
            .materials = {elastic_material("rubber", 1000, 1e6, 0.3)},
            .bodies = {disk}};
}

}  // namespace mpm::test
