#pragma once

#include "collective/communicator.hpp"
#include "collective/failure.hpp"

#include <mpi.h>

#include <memory>

namespace rrcb::mpi {

/// Attaches one value of a type to a communicator, which then owns it. Not collective.
template <class Value>
class Attribute {
  public:
    /// Returns the value of `comm`, or null. If a rank had no memory for the attribute's key, it
    /// could not attach values, so no communicator with this rank has one.
    static Value* find(MPI_Comm comm) {
        void* value = nullptr;
        int found = 0;
        if (attempt([] { key(); }).failed) return nullptr;
        check(MPI_Comm_get_attr(comm, key(), &value, &found), "MPI_Comm_get_attr");
        return found != 0 ? static_cast<Value*>(value) : nullptr;
    }

    /// Attaches a value. If it throws Error, nothing is attached.
    static Value* keep(std::unique_ptr<Value> value, MPI_Comm comm) {
        check(MPI_Comm_set_attr(comm, key(), value.get()), "MPI_Comm_set_attr");
        return value.release();
    }

    /// Frees the value of `comm`.
    static int forget(MPI_Comm comm) { return MPI_Comm_delete_attr(comm, key()); }

  private:
    static int free(MPI_Comm, int, void* value, void*) {
        delete static_cast<Value*>(value);
        return MPI_SUCCESS;
    }

    static int create_key() {
        int key = MPI_KEYVAL_INVALID;
        check(MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, free, &key, nullptr),
              "MPI_Comm_create_keyval");
        return key;
    }

    static int key() {
        static const int key = create_key();
        return key;
    }
};

}  // namespace rrcb::mpi
