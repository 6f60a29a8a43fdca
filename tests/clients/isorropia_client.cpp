// isorropia_client [points]: a cloud of points with values, partitioned by Isorropia's RCB, which
// is Zoltan's, and moved there; no word of RRCB.
#include "result.hpp"

#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_MultiVector.h>
#include <Isorropia_EpetraPartitioner.hpp>
#include <Isorropia_EpetraRedistributor.hpp>

#include <random>

namespace {

Teuchos::RCP<Epetra_MultiVector> cloud_of(const Epetra_Map& map) {
    const Teuchos::RCP<Epetra_MultiVector> cloud = Teuchos::rcp(new Epetra_MultiVector(map, 3));
    std::mt19937 random(static_cast<unsigned>(map.Comm().MyPID() + 1));
    std::normal_distribution<double> normal(0, 1);
    for (int i = 0; i < map.NumMyElements(); ++i) {
        for (int axis = 0; axis < 3; ++axis) (*cloud)[axis][i] = normal(random);
    }
    return cloud;
}

int run(int points) {
    const Epetra_MpiComm comm(MPI_COMM_WORLD);
    const Epetra_Map map(-1, points * (comm.MyPID() + 1), 0, comm);
    const Teuchos::RCP<const Epetra_MultiVector> cloud = cloud_of(map);
    Teuchos::ParameterList list;
    list.set("PARTITIONING METHOD", "RCB");
    list.sublist("ZOLTAN").set("DEBUG_LEVEL", "0");
    const auto partitioner = Teuchos::rcp(new Isorropia::Epetra::Partitioner(cloud, list));
    Isorropia::Epetra::Redistributor redistributor(partitioner);
    const Teuchos::RCP<Epetra_MultiVector> moved = redistributor.redistribute(*cloud);
    std::array<double, 3> norms{};
    moved->Norm2(norms.data());
    const double imbalance = imbalance_of(moved->MyLength());
    print_result(moved->GlobalLength(), imbalance, {norms[0], norms[1], norms[2]});
    return moved->GlobalLength() == map.NumGlobalElements() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    const int code = run(argc > 1 ? std::atoi(argv[1]) : 1000);
    MPI_Finalize();
    return code;
}
