#include "output/probe_table_mpi.hpp"

#include "parallel/communicator_mpi.hpp"

#include <array>
#include <limits>

namespace mpm {

namespace {

/// Columns of the points, in the order in which the table has them.
constexpr std::array<const char*, 9> columns{
    "x", "y", "z", "stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};

/// The values of the columns, and 1 if the point is still in the domain.
using Row = std::array<double, columns.size() + 1>;

}  // namespace

ProbeTable::ProbeTable(const std::string& path, const Scene& scene, MPI_Comm comm) : comm_(comm) {
    for (const Probe& probe : scene.probes) {
        names_.push_back(probe.name);
        points_.push_back(nearest_point(scene, probe.position));
    }
    const bool is_writer = rank_of(comm) == 0;
    if (is_writer) file_.open(path);
    fail_together(is_writer && !file_ ? path + ": cannot be written" : "", comm);
    file_.precision(std::numeric_limits<double>::max_digits10);
    file_ << "step,time,probe,x,y,z,displacement_x,displacement_y,displacement_z";
    for (std::size_t c = 3; c < columns.size(); ++c) file_ << ',' << columns[c];
    file_ << std::endl;
}

void ProbeTable::write(const Simulation& simulation) {
    const Particles& particles = simulation.particles();
    std::vector<Row> local(points_.size(), Row{}), rows = local;
    const auto ids = particles["id"];
    for (std::size_t p = 0; p < ids.size(); ++p)
        for (std::size_t k = 0; k < points_.size(); ++k) {
            if (ids[p] != static_cast<double>(points_[k].number)) continue;
            for (std::size_t c = 0; c < columns.size(); ++c)
                if (particles.has_column(columns[c])) local[k][c] = particles[columns[c]][p];
            local[k].back() = 1;
        }
    // Only the owner of a point adds non-zero values, so the sum is exact.
    MPI_Reduce(local.data(), rows.data(), static_cast<int>(local.size() * std::tuple_size_v<Row>),
               MPI_DOUBLE, MPI_SUM, 0, comm_);
    if (!file_.is_open()) return;
    for (std::size_t k = 0; k < points_.size(); ++k) {
        if (rows[k].back() == 0) continue;
        file_ << simulation.step_count() << ',' << simulation.time() << ',' << names_[k];
        for (std::size_t a = 0; a < 3; ++a) file_ << ',' << rows[k][a];
        for (std::size_t a = 0; a < 3; ++a) file_ << ',' << rows[k][a] - points_[k].place[a];
        for (std::size_t c = 3; c < columns.size(); ++c) file_ << ',' << rows[k][c];
        file_ << '\n';
    }
    file_.flush();
}

}  // namespace mpm
