#pragma once

#include <rrcb/export.h>

#include <stdexcept>
#include <string>

namespace rrcb {

/// Kind of an error.
enum class ErrorCode {
    invalid_argument,  ///< the caller's mistake: points, weights or options
    out_of_memory,     ///< an allocation failed on some rank
    mpi,               ///< an MPI call returned an error, or ranks called differently
    internal           ///< a callback threw, or an invariant does not hold
};

/// The only exception of the library. Its text names the place and the fix.
///
/// A collective function throws the same code and text on every rank of the communicator. There is
/// one exception: if MPI itself fails, the state of the communicator depends on MPI, and some ranks
/// may get other texts or no error.
class RRCB_API Error : public std::runtime_error {
  public:
    /// Makes an error.
    ///
    /// @param code kind of the error
    /// @param what its text
    Error(ErrorCode code, const std::string& what) : std::runtime_error(what), code_(code) {}
    /// Makes an error without a text, if there is no memory for one.
    explicit Error(ErrorCode code) noexcept : std::runtime_error(""), code_(code) {}
    /// Returns the kind of error. Not collective.
    ErrorCode code() const noexcept { return code_; }

  private:
    ErrorCode code_;
};

}  // namespace rrcb
