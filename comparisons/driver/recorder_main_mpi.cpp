#include "recorder_main_mpi.hpp"

#include "gather_mpi.hpp"

#include <zoltan.h>

#include <exception>
#include <iostream>

namespace comparisons {

int run_recorder(
    int argc, char** argv, const std::string& name,
    const std::function<void(const std::string& directory, bool quick, MPI_Comm comm)>& record) {
    MPI_Init(&argc, &argv);
    float zoltan_version = 0;
    Zoltan_Initialize(argc, argv, &zoltan_version);
    const MPI_Comm comm = MPI_COMM_WORLD;
    const bool quick = argc == 3 && std::string(argv[2]) == "--quick";
    const bool is_understood = argc == 2 || quick;
    if (!is_understood && rank_of(comm) == 0)
        std::cerr << "usage: mpirun -n RANKS " << name << " DIRECTORY [--quick]\n";
    if (is_understood) {
        try {
            record(argv[1], quick, comm);
        } catch (const std::exception& error) {
            std::cerr << name << ": rank " << rank_of(comm) << ": " << error.what() << std::endl;
            MPI_Abort(comm, 1);
        }
    }
    MPI_Finalize();
    return is_understood ? 0 : 2;
}

}  // namespace comparisons
