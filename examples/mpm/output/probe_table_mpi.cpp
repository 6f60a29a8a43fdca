#include "output/probe_table_mpi.hpp"

#include "effects/probes.hpp"
#include "parallel/communicator_mpi.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace mpm {

namespace {

/// Columns of the points in the table, in its order.
constexpr std::array<const char*, 15> columns{"x",         "y",         "z",         "stress_xx",
                                              "stress_yy", "stress_zz", "stress_xy", "stress_yz",
                                              "stress_zx", "strain_xx", "strain_yy", "strain_zz",
                                              "strain_xy", "strain_yz", "strain_zx"};

using Row = std::array<double, columns.size()>;

/// Adds this rank's points to the rows of the probes that mark them.
void add_rows(const Particles& particles, std::vector<Row>& rows) {
    const auto marks = particles[probe_column];
    for (std::size_t c = 0; c < columns.size(); ++c) {
        if (!particles.has_column(columns[c])) continue;
        const auto values = particles[columns[c]];
        for (std::size_t p = 0; p < marks.size(); ++p)
            if (marks[p] > 0) rows[static_cast<std::size_t>(marks[p]) - 1][c] = values[p];
    }
}

}  // namespace

ProbeTable::ProbeTable(const std::string& path, const Scene& scene, MPI_Comm comm)
    : probes_(scene.probes), starts_(probed_points(scene)), comm_(comm) {
    const bool is_writer = rank_of(comm) == 0;
    if (is_writer) file_.open(path);
    fail_together(is_writer && !file_ ? path + ": cannot be written" : "", comm);
    file_.precision(std::numeric_limits<double>::max_digits10);
    file_ << "step,time,probe,x,y,z,displacement_x,displacement_y,displacement_z";
    for (std::size_t c = 3; c < columns.size(); ++c) file_ << ',' << columns[c];
    file_ << std::endl;
}

void ProbeTable::write(const Simulation& simulation) {
    std::vector<Row> local(probes_.size(), Row{}), rows = local;
    add_rows(simulation.particles(), local);
    // A point has one owner, so a sum is exact.
    MPI_Reduce(local.data(), rows.data(), static_cast<int>(local.size() * columns.size()),
               MPI_DOUBLE, MPI_SUM, 0, comm_);
    if (!file_.is_open()) return;
    for (std::size_t k = 0; k < probes_.size(); ++k) {
        const auto first = std::ranges::find(starts_, starts_[k]) - starts_.begin();
        const Row& row = rows[static_cast<std::size_t>(first)];
        file_ << simulation.step_count() << ',' << simulation.time() << ',' << probes_[k].name;
        for (std::size_t a = 0; a < 3; ++a) file_ << ',' << row[a];
        for (std::size_t a = 0; a < 3; ++a) file_ << ',' << row[a] - starts_[k][a];
        for (std::size_t c = 3; c < columns.size(); ++c) file_ << ',' << row[c];
        file_ << '\n';
    }
    file_.flush();
}

}  // namespace mpm
