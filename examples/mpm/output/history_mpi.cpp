#include "output/history_mpi.hpp"

#include "parallel/communicator_mpi.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace mpm {

namespace {

struct Extremes {
    double front_x, top_y, num_points;
};

/// Computes the extremes over the points of all ranks, and the largest number of points on a rank.
/// Collective.
Extremes extremes_of(const Simulation& simulation, double cell_size, double lower_x,
                     MPI_Comm comm) {
    const Positions at = simulation.positions();
    Extremes extremes{std::max(lower_x, simulation.front_x(cell_size)),
                      -std::numeric_limits<double>::infinity(), static_cast<double>(at.size())};
    for (const double y : at.y) extremes.top_y = std::max(extremes.top_y, y);
    MPI_Allreduce(MPI_IN_PLACE, &extremes, 3, MPI_DOUBLE, MPI_MAX, comm);
    return extremes;
}

/// Returns the position along x beyond which the given share of the mass is, m. Its error is at
/// most a millionth of the domain. Collective.
double front_of_mass(const Particles& particles, double share, double lower, double upper,
                     MPI_Comm comm) {
    constexpr std::size_t num_bins = 1024;
    const auto x = particles["x"], mass = particles["mass"];
    double width = (upper - lower) / num_bins, missing = 0;
    // The first histogram covers the domain. The second covers the bin that contains the position.
    for (const bool is_first : {true, false}) {
        std::array<double, num_bins> bins{};
        for (std::size_t p = 0; p < x.size(); ++p) {
            const double k = std::floor((x[p] - lower) / width), most = num_bins - 1;
            if (is_first || (k >= 0 && k <= most))
                bins[static_cast<std::size_t>(std::clamp(k, 0.0, most))] += mass[p];
        }
        MPI_Allreduce(MPI_IN_PLACE, bins.data(), num_bins, MPI_DOUBLE, MPI_SUM, comm);
        if (is_first) missing = share * std::accumulate(bins.begin(), bins.end(), 0.0);
        std::size_t k = 0;
        for (; k + 1 < num_bins && missing > bins[k]; ++k) missing -= bins[k];
        lower += width * static_cast<double>(k);
        width /= num_bins;
    }
    return lower;
}

}  // namespace

History::History(const std::string& path, const Scene& scene, MPI_Comm comm)
    : cell_size_(scene.grid.spacing),
      lower_x_(scene.grid.lower[0]),
      upper_x_(scene.grid.upper()[0]),
      comm_(comm) {
    const bool is_writer = rank_of(comm) == 0;
    if (is_writer) file_.open(path);
    fail_together(is_writer && !file_ ? path + ": cannot be written" : "", comm);
    file_.precision(std::numeric_limits<double>::max_digits10);
}

void History::write_head(const std::vector<std::pair<std::string, double>>& reports) {
    file_ << "step,time,dt,points,mass,center_x,center_y,center_z,momentum_x,momentum_y,momentum_z,"
             "kinetic_energy,strain_energy,potential_energy,front_x,front_99,top_y,imbalance,"
             "migrated,ghost_nodes,left";
    for (const auto& [name, value] : reports) file_ << ',' << name;
    file_ << '\n';
    has_head_ = true;
}

void History::write(const Simulation& simulation) {
    const Totals totals = simulation.totals();
    const Extremes extremes = extremes_of(simulation, cell_size_, lower_x_, comm_);
    const double front = front_of_mass(simulation.particles(), 0.99, lower_x_, upper_x_, comm_);
    if (!file_.is_open()) return;
    const auto reports = simulation.reports();
    if (!has_head_) write_head(reports);
    file_ << simulation.step_count() << ',' << simulation.time() << ',' << simulation.time_step()
          << ',' << totals.num_points << ',' << totals.mass;
    for (const double component : totals.center) file_ << ',' << component;
    for (const double component : totals.momentum) file_ << ',' << component;
    file_ << ',' << totals.kinetic_energy << ',' << totals.strain_energy << ','
          << totals.potential_energy << ',' << extremes.front_x << ',' << front << ','
          << extremes.top_y << ','
          << extremes.num_points * size_of(comm_) /
                 std::max(static_cast<double>(totals.num_points), 1.0)
          << ',' << totals.num_migrated - num_migrated_ << ',' << totals.num_ghost_nodes << ','
          << simulation.num_points() - totals.num_points;
    for (const auto& [name, value] : reports) file_ << ',' << value;
    file_ << std::endl;
    num_migrated_ = totals.num_migrated;
}

}  // namespace mpm
