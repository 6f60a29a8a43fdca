#include "collective/handles.hpp"

#include "collective/communicator.hpp"

namespace rrcb::mpi {

ContiguousType::ContiguousType(int count, MPI_Datatype element) {
    check(MPI_Type_contiguous(count, element, &type_), "MPI_Type_contiguous");
    const int code = MPI_Type_commit(&type_);
    if (code == MPI_SUCCESS) return;
    MPI_Type_free(&type_);
    check(code, "MPI_Type_commit");
}

ContiguousType::~ContiguousType() {
    MPI_Type_free(&type_);
}

Reduction::Reduction(MPI_User_function* function) {
    check(MPI_Op_create(function, 1, &op_), "MPI_Op_create");
}

Reduction::~Reduction() {
    MPI_Op_free(&op_);
}

}  // namespace rrcb::mpi
