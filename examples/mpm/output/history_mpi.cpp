#include "output/history_mpi.hpp"

#include "parallel/communicator_mpi.hpp"

#include <algorithm>
#include <limits>

namespace mpm {

namespace {

struct Extremes {
    double front_x, top_y, num_points;
};

/// Extremes over the points of all ranks, and the largest number of points of a rank. Collective.
Extremes extremes_of(const Simulation& simulation, double cell_size, double lower_x,
                     MPI_Comm comm) {
    const Positions at = simulation.positions();
    Extremes extremes{std::max(lower_x, simulation.front_x(cell_size)),
                      -std::numeric_limits<double>::infinity(), static_cast<double>(at.size())};
    for (const double y : at.y) extremes.top_y = std::max(extremes.top_y, y);
    MPI_Allreduce(MPI_IN_PLACE, &extremes, 3, MPI_DOUBLE, MPI_MAX, comm);
    return extremes;
}

}  // namespace

History::History(const std::string& path, const Scene& scene, MPI_Comm comm)
    : cell_size_(scene.grid.spacing), lower_x_(scene.grid.lower[0]), comm_(comm) {
    const bool is_writer = rank_of(comm) == 0;
    if (is_writer) file_.open(path);
    fail_together(is_writer && !file_ ? path + ": cannot be written" : "", comm);
    file_.precision(std::numeric_limits<double>::max_digits10);
}

void History::write_head(const std::vector<std::pair<std::string, double>>& reports) {
    file_ << "step,time,dt,points,mass,center_x,center_y,center_z,momentum_x,momentum_y,momentum_z,"
             "kinetic_energy,strain_energy,potential_energy,front_x,top_y,imbalance,migrated,ghost_"
             "nodes";
    for (const auto& [name, value] : reports) file_ << ',' << name;
    file_ << '\n';
    has_head_ = true;
}

void History::write(const Simulation& simulation) {
    const Totals totals = simulation.totals();
    const Extremes extremes = extremes_of(simulation, cell_size_, lower_x_, comm_);
    if (!file_.is_open()) return;
    const auto reports = simulation.reports();
    if (!has_head_) write_head(reports);
    file_ << simulation.step_count() << ',' << simulation.time() << ',' << simulation.time_step()
          << ',' << totals.num_points << ',' << totals.mass;
    for (const double component : totals.center) file_ << ',' << component;
    for (const double component : totals.momentum) file_ << ',' << component;
    file_ << ',' << totals.kinetic_energy << ',' << totals.strain_energy << ','
          << totals.potential_energy << ',' << extremes.front_x << ',' << extremes.top_y << ','
          << extremes.num_points * size_of(comm_) / static_cast<double>(totals.num_points) << ','
          << totals.num_migrated - num_migrated_ << ',' << totals.num_ghost_nodes;
    for (const auto& [name, value] : reports) file_ << ',' << value;
    file_ << std::endl;
    num_migrated_ = totals.num_migrated;
}

}  // namespace mpm
