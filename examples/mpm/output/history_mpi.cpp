#include "output/history_mpi.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace mpm {

namespace {

struct Reach {
    double front_x, top_y, num_points;
};

/// The largest over the points of all ranks, and of the numbers of points.
Reach reach_of(const Simulation& simulation, double cell_size, double lower_x, MPI_Comm comm) {
    const Particles& particles = simulation.particles();
    const Positions at = simulation.positions();
    std::array<std::span<const double>, 3> displacement{
        particles["displacement_x"], particles["displacement_y"], {}};
    if (!at.z.empty()) displacement[2] = particles["displacement_z"];
    Reach reach{lower_x, -std::numeric_limits<double>::infinity(), static_cast<double>(at.size())};
    for (std::size_t p = 0; p < at.size(); ++p) {
        double square = 0;
        for (const auto column : displacement) square += column.empty() ? 0 : column[p] * column[p];
        if (square > cell_size * cell_size) reach.front_x = std::max(reach.front_x, at.x[p]);
        reach.top_y = std::max(reach.top_y, at.y[p]);
    }
    MPI_Allreduce(MPI_IN_PLACE, &reach, 3, MPI_DOUBLE, MPI_MAX, comm);
    return reach;
}

}  // namespace

void fail_together(const std::string& text, MPI_Comm comm) {
    std::string told = text;
    auto length = static_cast<int>(told.size());
    MPI_Bcast(&length, 1, MPI_INT, 0, comm);
    told.resize(static_cast<std::size_t>(length));
    MPI_Bcast(told.data(), length, MPI_CHAR, 0, comm);
    if (!told.empty()) throw std::runtime_error(told);
}

History::History(const std::string& path, const Scene& scene, MPI_Comm comm)
    : cell_size_(scene.grid.spacing), lower_x_(scene.grid.lower[0]), comm_(comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    if (rank == 0) file_.open(path);
    fail_together(rank == 0 && !file_ ? path + ": cannot be written" : "", comm);
    file_.precision(std::numeric_limits<double>::max_digits10);
}

void History::write_head(const std::vector<std::pair<std::string, double>>& reports) {
    file_ << "step,time,dt,points,mass,center_x,center_y,center_z,momentum_x,momentum_y,momentum_z,"
             "kinetic_energy,strain_energy,potential_energy,dissipated_energy,front_x,top_y,"
             "imbalance,migrated";
    for (const auto& [name, value] : reports) file_ << ',' << name;
    file_ << '\n';
    has_head_ = true;
}

void History::write(const Simulation& simulation) {
    const Totals totals = simulation.totals();
    const Reach reach = reach_of(simulation, cell_size_, lower_x_, comm_);
    int num_ranks = 1;
    MPI_Comm_size(comm_, &num_ranks);
    if (!file_.is_open()) return;
    const auto reports = simulation.reports();
    if (!has_head_) write_head(reports);
    file_ << simulation.step_count() << ',' << simulation.time() << ',' << simulation.time_step()
          << ',' << totals.num_points << ',' << totals.mass;
    for (const double component : totals.center) file_ << ',' << component;
    for (const double component : totals.momentum) file_ << ',' << component;
    file_ << ',' << totals.kinetic_energy << ',' << totals.strain_energy << ','
          << totals.potential_energy << ',';
    if (totals.dissipated_energy) file_ << *totals.dissipated_energy;
    file_ << ',' << reach.front_x << ',' << reach.top_y << ','
          << reach.num_points * num_ranks / static_cast<double>(totals.num_points) << ','
          << totals.num_migrated - num_migrated_;
    for (const auto& [name, value] : reports) file_ << ',' << value;
    file_ << std::endl;
    num_migrated_ = totals.num_migrated;
}

}  // namespace mpm
