#include "flow_mpi.hpp"

#include "counter_random.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace comparisons {

namespace {

constexpr double leaving = 0.01;  ///< share of a rank's points that leave it in a step

/// Returns the area of the inner faces of a box divided by its volume, as a mean over the ranks.
double inner_faces(const rrcb::Cuts& cuts, const std::array<int, 3>& cubes) {
    double sum = 0;
    for (rrcb::Part part = 0; part < cuts.num_parts; ++part) {
        const rrcb::Box box = rrcb::box_of(cuts, part);
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(cuts.dimension); ++axis) {
            const bool has_lower = std::isfinite(box.lower[axis]);
            const bool has_upper = std::isfinite(box.upper[axis]);
            const double length =
                (has_upper ? box.upper[axis] : cubes[axis]) - (has_lower ? box.lower[axis] : 0);
            sum += (has_lower + has_upper) / length;
        }
    }
    return sum / cuts.num_parts;
}

}  // namespace

Flow::Flow(int dimension, std::int64_t points_per_rank, MPI_Comm comm)
    : comm_(comm), radius_(2 * std::pow(static_cast<double>(points_per_rank), -1.0 / dimension)) {
    int num_ranks = 1;
    MPI_Comm_rank(comm, &rank_);
    MPI_Comm_size(comm, &num_ranks);
    MPI_Dims_create(num_ranks, dimension, cubes_.data());
    start_.dimension = dimension;
    for (std::int64_t id = rank_ * points_per_rank; id < (rank_ + 1) * points_per_rank; ++id) {
        CounterRandom random(1, static_cast<std::uint64_t>(id));
        for (int axis = 0; axis < dimension; ++axis) {
            start_.x.push_back(random.uniform(0, cubes_[static_cast<std::size_t>(axis)]));
            start_.v.push_back(0);
        }
        start_.ids.push_back(id);
    }
    const rrcb::Balance balance = rrcb::balance(start_.points(), comm);
    cuts_ = balance.cuts;
    std::tie(start_.x, start_.v, start_.ids) = rrcb::transfer(
        rrcb::plan(balance, comm),
        rrcb::columns(start_.column(start_.x), start_.column(start_.v), start_.ids), comm);
    // Of a layer of thickness t next to a face, a quarter of the points cross the face in jumps
    // that are uniformly distributed up to a length of t.
    if (num_ranks > 1) travel_ = 4 * leaving / inner_faces(cuts_, cubes_);
}

void Flow::move(Particles& particles, int step) const {
    const std::size_t width = particles.width();
    for (std::size_t i = 0; i < particles.size(); ++i) {
        CounterRandom random(static_cast<std::uint64_t>(step) + 2,
                             static_cast<std::uint64_t>(particles.ids[i]));
        for (std::size_t axis = 0; axis < width; ++axis) {
            double& x = particles.x[i * width + axis];
            const double before = x;
            x = std::abs(x + random.uniform(-travel_, travel_));
            if (x > cubes_[axis]) x = 2 * cubes_[axis] - x;
            particles.v[i * width + axis] = x - before;
        }
    }
}

void Flow::jump(Particles& particles) const {
    for (std::size_t axis = 0; axis < particles.width(); ++axis) particles.x[axis] = cubes_[axis];
}

void Flow::push(Particles& particles) const {
    const auto write = [&](double scale, const std::vector<double>& x, const std::vector<double>& v,
                           std::vector<double>& forces) {
        forces.resize(x.size());
        for (std::size_t k = 0; k < x.size(); ++k) forces[k] = scale * (x[k] - v[k] / 3);
    };
    write(1, particles.x, particles.v, particles.forces);
    write(rank_ + 2, particles.ghost_x, particles.ghost_v, particles.ghost_forces);
}

}  // namespace comparisons
