#pragma once

#include "collective/communicator.hpp"

#include <mpi.h>

namespace rrcb::mpi {

/// A handle of MPI that make(handle) makes; freed with the object.
template <class Handle, int (*free_handle)(Handle*)>
class Owned {
  public:
    /// Throws Error that names the `call` in make().
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
