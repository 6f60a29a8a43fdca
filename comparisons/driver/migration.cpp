// How many points change rank when points that move are rebalanced, as CSV.
//
//   mpirun -n RANKS rrcb_migration DIRECTORY [--quick]     adds to migration.csv; with --quick: of
//       two small cubes and a coarse slope
#include "drifting_cube_mpi.hpp"
#include "failure.hpp"
#include "migration_replay_mpi.hpp"
#include "partitioner_mpi.hpp"
#include "recorder_main_mpi.hpp"
#include "results_folder_mpi.hpp"
#include "text.hpp"
#include "zoltan_balancer_mpi.hpp"

#include <rrcb/zoltan/rrcb_zoltan.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace {

using namespace comparisons;

constexpr const char* compared =
    "zoltan-rcb,zoltan-rcb[reuse],zoltan-rcb[reuse,lock],rrcb,"
    "rrcb-exact,rrcb[reuse]";

/// A scene or a cloud that moves to its end, at so many times.
PointTracks tracks_of(MovingPoints& points, int num_times, MPI_Comm comm) {
    const mpm::Balancer balancer = *make_balancer(read_method("rrcb-arrays"));
    PointTracks tracks(comm);
    const int num_steps = points.num_steps();
    for (int step = 0; step <= num_steps; ++step) {
        while (tracks.num_times() * num_steps <= step * (num_times - 1)) {
            tracks.add(points);
            points.rebalance(balancer);
        }
        if (step < num_steps) points.step();
    }
    return tracks;
}

/// Through Zoltan's callbacks and lists, with part numbers that keep points in place, as by
/// default.
mpm::Balancer balancer_of(const Method& method) {
    ZoltanParameters parameters = zoltan_parameters(method, Lists::parts);
    parameters.emplace_back("REMAP", "1");
    return zoltan_balancer(std::move(parameters));
}

/// What was recorded.
struct Recorded {
    std::string scene;
    std::string seed;  ///< empty where there is none
    int num_ranks;
};

Row row_of(const Recorded& recorded, const std::string& method, Between between,
           const Migration& result) {
    const double all = static_cast<double>(result.points) * std::max(1, result.calls);
    return Row()
        .add("scene", recorded.scene)
        .add("ranks", recorded.num_ranks)
        .add("seed", recorded.seed)
        .add("between", between == Between::follow ? "follow" : "stay")
        .add("method", method)
        .add("calls", result.calls)
        .add("points", result.points)
        .add("moved_points", result.moved)
        .add("crossed_points", result.crossed)
        .add("moved_fraction", static_cast<double>(result.moved) / all)
        .add("crossed_fraction", static_cast<double>(result.crossed) / all)
        .add("mean_imbalance", result.mean_imbalance)
        .add("worst_imbalance", result.worst_imbalance);
}

void replay(const ResultsFolder& folder, const Recorded& recorded, const PointTracks& tracks,
            MPI_Comm comm) {
    std::vector<Row> rows;
    for (const Between between : {Between::follow, Between::stay}) {
        for (const Method& method : read_methods(compared)) {
            const Migration result = replay_migration(tracks, balancer_of(method), between, comm);
            rows.push_back(row_of(recorded, method.label, between, result));
        }
    }
    folder.append("migration.csv", [&] { return rows; });
}

void replay_all(const ResultsFolder& folder, bool quick, MPI_Comm comm) {
    if (RRCB_Zoltan_Active() == 0) throw Failure("rrcb_zoltan is not in front of Zoltan");
    int num_ranks = 1;
    MPI_Comm_size(comm, &num_ranks);
    const std::uint64_t num_seeds = quick ? 2 : 6;
    for (const double speed : {1e-4, 1e-3, 1e-2}) {
        for (std::uint64_t seed = 1; seed <= num_seeds; ++seed) {
            DriftingCube cube{.speed = speed, .seed = seed};
            if (quick) cube.num_points = 2000;
            replay(folder, {"cube, " + fixed(100 * speed, 2) + " %", write_number(seed), num_ranks},
                   tracks_of(cube, comm), comm);
        }
        if (quick) break;
    }
    const int num_times = quick ? 5 : 101;
    for (const auto& [name, cloud] : drifting_clouds(quick)) {
        if (quick) break;
        replay(folder, {name, "", num_ranks},
               tracks_of(*cloud_points(cloud, comm), num_times, comm), comm);
    }
    for (const char* scene :
         {"slope", "submarine_slide", "torpedo_anchor", "anchor_plate", "dam_break"}) {
        replay(folder, {scene, "", num_ranks},
               tracks_of(*scene_points(scene, quick, comm), num_times, comm), comm);
        if (quick) break;
    }
}

}  // namespace

int main(int argc, char** argv) {
    return comparisons::run_recorder(argc, argv, "rrcb_migration",
                                     [](const std::string& directory, bool quick, MPI_Comm comm) {
                                         replay_all({directory, comm}, quick, comm);
                                     });
}
