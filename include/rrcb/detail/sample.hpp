#pragma once

#include <rrcb/detail/mix.hpp>
#include <rrcb/points.hpp>

#include <cstddef>

namespace rrcb {
namespace detail {

/// Returns entry k of a sample of `count` points. The sample is random, because regular steps would
/// alias with a lattice, but the same in every call. Some of its entries may be equal.
inline LocalIndex sampled(std::size_t k, LocalIndex count) {
    return mix(k + 1) % count;
}

}  // namespace detail
}  // namespace rrcb
