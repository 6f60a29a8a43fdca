#include "sweep_mpi.hpp"

#include "cycle_mpi.hpp"
#include "error_sources_mpi.hpp"
#include "paper_study_mpi.hpp"
#include "sweep_part_mpi.hpp"
#include "table.hpp"

namespace comparisons {

bool run_sweep(const Arguments& arguments, const ResultsFolder& folder, Progress& progress,
               MPI_Comm comm) {
    Sweep sweep{arguments, folder, progress, comm};
    MPI_Comm_rank(comm, &sweep.rank);
    MPI_Comm_size(comm, &sweep.num_ranks);
    SavedRows rows(folder, "sweep.csv", table_header(), 9);
    bool succeeded = true;
    if (sweep.includes("clouds")) {
        succeeded = on_each_cloud(sweep, arguments.points, [&](const Workload& workload) {
            return measure_missing(sweep, workload, arguments.methods, rows);
        });
    }
    if (sweep.includes("sources")) find_error_sources(sweep);
    if (sweep.includes("snapshots")) succeeded = study_snapshots(sweep, rows) && succeeded;
    if (sweep.includes("cycle")) succeeded = study_cycle(sweep) && succeeded;
    if (sweep.includes("ranks")) succeeded = study_ranks(sweep) && succeeded;
    if (sweep.includes("simulations")) succeeded = study_simulations(sweep) && succeeded;
    if (sweep.includes("paper")) succeeded = study_paper(sweep) && succeeded;
    return succeeded;
}

}  // namespace comparisons
