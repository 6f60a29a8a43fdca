#include "workload_mpi.hpp"

#include "failure_mpi.hpp"
#include "points_file.hpp"

#include <filesystem>

namespace comparisons {

Workload cloud_workload(const Cloud& cloud, Layout layout, MPI_Comm comm) {
    int rank = 0;
    int size = 0;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
    Workload workload;
    workload.name = cloud.name;
    workload.layout = layout_name(layout);
    workload.dimension = cloud.dimension;
    workload.coordinates =
        cloud_points(cloud, cloud.num_points * rank / size, cloud.num_points * (rank + 1) / size);
    distribute(workload, layout, cloud.seed, comm);
    return workload;
}

Workload file_workload(const std::string& file, Layout layout, std::uint64_t seed, MPI_Comm comm) {
    Workload workload;
    on_root([&] { workload = read_points_file(file); }, comm);
    MPI_Bcast(&workload.dimension, 1, MPI_INT, 0, comm);
    MPI_Bcast(&workload.weighted, 1, MPI_CXX_BOOL, 0, comm);
    workload.name = std::filesystem::path(file).stem().string();
    workload.layout = layout_name(layout);
    distribute(workload, layout, seed, comm);
    return workload;
}

}  // namespace comparisons
