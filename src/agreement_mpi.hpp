#pragma once

#include "contribution.hpp"
#include "failure.hpp"

#include <mpi.h>

#include <span>
#include <vector>

namespace rrcb {

inline constexpr int root = 0;
inline constexpr int no_rank = -1;

/// Headers of all ranks at the root; empty elsewhere. Collective over `comm`.
std::vector<Header> gather_headers(const Header& mine, MPI_Comm comm);

/// Throws the same Error on every rank when one of them failed or their options differ.
///
/// Collective over `comm`. `failure` is what this rank held back, `headers` count at the root.
void agree(std::span<const Header> headers, Failure& failure, MPI_Comm comm);

/// Throws the same Error on every rank when one of them failed on its own since they agreed last.
///
/// Collective over `comm`: one reduction.
void agree(const Failure& failure, MPI_Comm comm);

/// Throws the failure of the failing rank on every rank. Collective over `comm`.
[[noreturn]] void fail_together(int failing_rank, const Failure& failure, MPI_Comm comm);

}  // namespace rrcb
