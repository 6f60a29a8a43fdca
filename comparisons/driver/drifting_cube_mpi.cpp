#include "drifting_cube_mpi.hpp"

#include "counter_random.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace comparisons {

namespace {

/// Where in 0 ... 1 a point is that would have come to `at` without sides.
double reflected(double at) {
    return std::abs(std::remainder(at, 2));
}

/// Where point number `id` is once all have gone so far. Directions are uniform on the sphere, as
/// their heights are.
mpm::Vector place_of(const DriftingCube& cube, std::int64_t id, double distance) {
    CounterRandom random(cube.seed, static_cast<std::uint64_t>(id));
    mpm::Vector at{random.uniform(), random.uniform(), random.uniform()};
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double height = random.uniform(-1, 1);
    const double width = std::sqrt(1 - height * height);
    const mpm::Vector way{width * std::cos(angle), width * std::sin(angle), height};
    for (std::size_t a = 0; a < at.size(); ++a) at[a] = reflected(at[a] + distance * way[a]);
    return at;
}

}  // namespace

PointTracks tracks_of(const DriftingCube& cube, MPI_Comm comm) {
    int rank = 0;
    int num_ranks = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &num_ranks);
    const std::int64_t end = cube.num_points * (rank + 1) / num_ranks;
    PointTracks tracks(comm);
    for (int time = 0; time < cube.num_times; ++time) {
        PointTracks::Columns columns;
        for (std::int64_t id = cube.num_points * rank / num_ranks; id < end; ++id) {
            const mpm::Vector at = place_of(cube, id, cube.speed * time);
            for (std::size_t a = 0; a < columns.size(); ++a) columns[a].push_back(at[a]);
        }
        tracks.add(std::move(columns));
    }
    return tracks;
}

}  // namespace comparisons
