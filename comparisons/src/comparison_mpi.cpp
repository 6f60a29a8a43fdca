#include "comparison_mpi.hpp"

#include "plot_data_mpi.hpp"

#include <algorithm>
#include <iostream>
#include <utility>

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
    std::vector<Method> methods = arguments.methods;
    const auto reference = std::ranges::find(methods, "zoltan-rcb", &Method::label);
    const bool is_twice = reference != methods.end();
    if (is_twice) methods.push_back(Method(*reference));
    comparison.measurements = measure(workload, methods, comparison.plan, progress, comm);
    if (is_twice) {
        comparison.second_times_ms = std::move(comparison.measurements.back().times_ms);
        comparison.measurements.pop_back();
    }
    write_plot_data(folder, workload, arguments.methods, comparison.measurements, comm);
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    if (rank == 0) print_table(std::cout, comparison);
    std::cout.flush();
    return comparison;
}

}  // namespace comparisons
