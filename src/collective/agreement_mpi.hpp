#pragma once

#include "collective/participant.hpp"

#include <mpi.h>

#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace rrcb {

inline constexpr int root = 0;

/// Throws the same Error on every rank when one of them failed on its own since they agreed last.
///
/// Collective: one reduction.
void agree(const Participant& self);

/// An argument that is to be the same on every rank.
struct Shared {
    std::string_view name;
    std::uint64_t value = 0;
};

/// The same, and throws where one of `arguments` differs between the ranks, all of which name the
/// same ones, at most three.
///
/// Collective: one reduction. What follows may be shaped by these arguments.
void agree(const Participant& self, std::initializer_list<Shared> arguments);

/// Throws on every rank what failed on `failing_rank`; nothing where it is no_rank.
///
/// Collective where it throws, after all ranks were told the same number: one broadcast, before it
/// agree() for some_rank.
void fail_together(int failing_rank, const Participant& self);

}  // namespace rrcb
