#pragma once

#include "member.hpp"

#include <mpi.h>

namespace rrcb {

inline constexpr int root = 0;

/// Throws the same Error on every rank when one of them failed on its own since they agreed last.
///
/// Collective: one reduction.
void agree(const Member& me);

/// Throws the failure of the failing rank on every rank. Collective.
[[noreturn]] void fail_together(int failing_rank, const Member& me);

}  // namespace rrcb
