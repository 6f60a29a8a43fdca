#pragma once

#include <rrcb/detail/mix.hpp>
#include <rrcb/points.hpp>

#include <cstddef>

namespace rrcb {
namespace detail {

/// Returns entry k of a sample of `count` points: at random, as regular steps would alias with a
/// lattice, but the same in every call. Some entries are equal.
inline LocalIndex sampled(std::size_t k, LocalIndex count) {
    return mix(k + 1) % count;
}

}  // namespace detail
}  // namespace rrcb
