// ml_client [points]: Poisson's equation by conjugate gradients, preconditioned by ML's smoothed
// aggregation, whose coarse levels are repartitioned by Zoltan's RCB; no word of RRCB.
#include "poisson.hpp"
#include "result.hpp"

#include <AztecOO.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <ml_MultiLevelPreconditioner.h>

namespace {

Epetra_CrsMatrix matrix_of(const Poisson& problem, const Epetra_Map& map) {
    Epetra_CrsMatrix matrix(Copy, map, 7);
    for (int i = 0; i < problem.num_rows(); ++i) {
        const std::vector<int> columns = problem.columns_of(problem.row(i));
        std::vector<double> values(columns.size(), -1);
        values[0] = 6;
        matrix.InsertGlobalValues(problem.row(i), static_cast<int>(columns.size()), values.data(),
                                  columns.data());
    }
    matrix.FillComplete();
    return matrix;
}

Teuchos::ParameterList parameters_with(std::array<std::vector<double>, 3>& coordinates) {
    Teuchos::ParameterList list;
    ML_Epetra::SetDefaults("SA", list);
    list.set("ML output", 0);
    list.set("repartition: enable", 1);
    list.set("repartition: partitioner", "Zoltan");
    list.set("repartition: Zoltan dimensions", 3);
    list.set("repartition: max min ratio", 1.1);
    list.set("repartition: min per proc", 20);
    list.set("repartition: put on single proc", 1);
    list.set("x-coordinates", coordinates[0].data());
    list.set("y-coordinates", coordinates[1].data());
    list.set("z-coordinates", coordinates[2].data());
    return list;
}

std::array<std::vector<double>, 3> coordinates_of(const Poisson& problem) {
    std::array<std::vector<double>, 3> coordinates;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < problem.num_rows(); ++i) {
            coordinates[static_cast<std::size_t>(axis)].push_back(
                problem.coordinate(problem.row(i), axis));
        }
    }
    return coordinates;
}

/// Of the first coarse level, which is what RCB divides first.
double coarse_imbalance(const ML_Epetra::MultiLevelPreconditioner& preconditioner) {
    return imbalance_of(preconditioner.GetML()->Amat[1].outvec_leng);
}

int solve(int points) {
    const Epetra_MpiComm comm(MPI_COMM_WORLD);
    const Poisson problem(points, comm.MyPID(), comm.NumProc());
    const Epetra_Map map(-1, problem.num_rows(), 0, comm);
    Epetra_CrsMatrix matrix = matrix_of(problem, map);
    std::array<std::vector<double>, 3> coordinates = coordinates_of(problem);
    const Teuchos::ParameterList list = parameters_with(coordinates);
    ML_Epetra::MultiLevelPreconditioner preconditioner(matrix, list);
    Epetra_Vector solution(map), right(map);
    right.PutScalar(1);
    Epetra_LinearProblem system(&matrix, &solution, &right);
    AztecOO solver(system);
    solver.SetPrecOperator(&preconditioner);
    solver.SetAztecOption(AZ_solver, AZ_cg);
    solver.SetAztecOption(AZ_output, AZ_none);
    const int code = solver.Iterate(100, 1e-10);
    double largest = 0, norm = 0;
    solution.MaxValue(&largest);
    solution.Norm2(&norm);
    print_result(map.NumGlobalElements(), coarse_imbalance(preconditioner), {largest, norm});
    if (comm.MyPID() == 0) std::printf("%d iterations\n", solver.NumIters());
    return code == 0 && problem.is_solved(largest) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    const int code = solve(argc > 1 ? std::atoi(argv[1]) : 15);
    MPI_Finalize();
    return code;
}
