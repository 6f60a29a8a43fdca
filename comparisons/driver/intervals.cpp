// What rebalances cost over the interval between them, beside what unbalance costs, as CSV.
//
//   mpirun -n RANKS rrcb_intervals DIRECTORY [--quick]     adds to intervals.csv,
//       intervals_optimum.csv and intervals_steps.csv; with --quick: two small scenes
#include "failure.hpp"
#include "gather_mpi.hpp"
#include "interval_recording_mpi.hpp"
#include "machine_load_mpi.hpp"
#include "recorder_main_mpi.hpp"
#include "results_folder_mpi.hpp"
#include "row.hpp"

#include <rrcb/zoltan/rrcb_zoltan.h>

#include <mpi.h>

#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace comparisons;

/// Its steps are written one by one.
constexpr const char* shown_by_steps = "slope";

void append(const ResultsFolder& folder, const MappedScene& scene) {
    folder.append("intervals.csv", [&] { return map_rows(scene); });
    folder.append("intervals_optimum.csv", [&] { return optimum_rows(scene); });
    if (scene.scene != shown_by_steps) return;
    folder.append("intervals_steps.csv", [&] { return step_rows(scene); });
}

void map_all(const ResultsFolder& folder, bool quick, MPI_Comm comm) {
    if (RRCB_Zoltan_Active() == 0) throw Failure("rrcb_zoltan is not in front of Zoltan");
    const std::vector<Method> methods = read_methods("zoltan-rcb,rrcb,rrcb-arrays");
    IntervalRecording recording;
    if (quick) recording = {"", 11, 2, 2, 0};
    double of_slope = 0;
    for (const char* scene : {"slope", "granular_column", "submarine_slide", "dam_break"}) {
        recording.scene = scene;
        const RecordedScene recorded =
            record_intervals(*scene_points(scene, quick, comm), methods, recording, comm);
        if (of_slope == 0) of_slope = recorded.seconds_per_point;
        append(folder, recorded.map);
        if (quick) break;
    }
    // The points of a cloud do no work; theirs is taken to be that of the slope's.
    recording.seconds_per_point = of_slope;
    for (const auto& [name, cloud] : drifting_clouds(quick)) {
        recording.scene = name;
        append(folder, record_intervals(*cloud_points(cloud, comm), methods, recording, comm).map);
        if (quick) break;
    }
}

}  // namespace

int main(int argc, char** argv) {
    return comparisons::run_recorder(argc, argv, "rrcb_intervals",
                                     [](const std::string& directory, bool quick, MPI_Comm comm) {
                                         const comparisons::MachineWatch watch(comm);
                                         map_all({directory, comm}, quick, comm);
                                         const comparisons::MachineUse use = watch.use();
                                         if (comparisons::rank_of(comm) == 0)
                                             comparisons::print_warning(std::cout, use);
                                     });
}
