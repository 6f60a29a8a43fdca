#pragma once

#include "collective/communicator.hpp"

#include <mpi.h>

namespace rrcb::mpi {

/// A handle of MPI that make(handle) creates. It is freed together with this object.
template <class Handle, int (*free_handle)(Handle*)>
class Owned {
  public:
    /// If make() fails, throws Error with the name of the MPI function, `call`.
    template <class Make>
    Owned(Make&& make, const char* call) {
        check(make(&handle_), call);
    }
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;
    ~Owned() { free_handle(&handle_); }

    Handle get() const { return handle_; }

  private:
    Handle handle_;
};

}  // namespace rrcb::mpi
