#include "comparison_mpi.hpp"

#include "plot_data_mpi.hpp"

#include <iostream>

namespace comparisons {

Comparison describe(const Workload& workload, const MeasurementPlan& plan, MPI_Comm comm) {
    Comparison comparison{workload.name, workload.layout, workload.dimension, 0, 1, plan, {}};
    const auto count = static_cast<rrcb::GlobalCount>(workload.points().count);
    MPI_Allreduce(&count, &comparison.num_points, 1, MPI_INT64_T, MPI_SUM, comm);
    MPI_Comm_size(comm, &comparison.num_ranks);
    return comparison;
}

Comparison compare_methods(const Workload& workload, const Arguments& arguments,
                           const ResultsFolder& folder, Progress& progress, MPI_Comm comm) {
    Comparison comparison = describe(workload, {arguments.lists, arguments.repeats}, comm);
    comparison.measurements = measure(workload, arguments.methods, comparison.plan, progress, comm);
    write_plot_data(folder, workload, arguments.methods, comparison.measurements, comm);
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    if (rank == 0) print_table(std::cout, comparison);
    std::cout.flush();
    return comparison;
}

}  // namespace comparisons
