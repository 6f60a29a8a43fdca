#pragma once

#include <cstdint>

namespace rrcb {

/// How this thread rounds and treats subnormal numbers, found out by computing: ranks with
/// different numbers get different results from the same operands. Not collective.
std::uint64_t arithmetic_in_use();

}  // namespace rrcb
