#pragma once

#include <mpi.h>

namespace rrcb::mpi {

/// Datatype of consecutive elements; freed with the object.
class ContiguousType {
  public:
    /// Throws Error.
    ContiguousType(int count, MPI_Datatype element);
    ContiguousType(const ContiguousType&) = delete;
    ContiguousType& operator=(const ContiguousType&) = delete;
    ~ContiguousType();

    MPI_Datatype get() const { return type_; }

  private:
    MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

/// Commutative reduction; freed with the object.
class Reduction {
  public:
    /// Throws Error.
    explicit Reduction(MPI_User_function* function);
    Reduction(const Reduction&) = delete;
    Reduction& operator=(const Reduction&) = delete;
    ~Reduction();

    MPI_Op get() const { return op_; }

  private:
    MPI_Op op_ = MPI_OP_NULL;
};

}  // namespace rrcb::mpi
