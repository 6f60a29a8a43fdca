#pragma once

#include "collective/participant.hpp"

#include <rrcb/points.hpp>

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace rrcb {

inline constexpr int root = 0;

/// Argument that must be the same on every rank, except on those that need none.
struct Shared {
    std::string_view name;
    std::uint64_t value = 0;
    bool is_needed = true;  ///< on this rank; if not, it accepts any value
    std::string_view fix = "give the same value on every rank";
};

/// Returns whether the points have weights, as an argument to compare.
Shared weights_given(const Points& points);

/// Returns the text of the Error for an argument that differs between two ranks.
std::string difference(std::string_view name, std::string_view fix, int rank, int other);

/// Throws the same Error on every rank if any rank has failed since the last agreement, or if one
/// of `arguments` differs between the ranks.
///
/// The Error is that of the lowest rank whose failure no other one caused, or else of the lowest
/// failing rank. Collective: one reduction; if it is the meeting of the call, up the MergeTree and
/// by a broadcast, R - 1 messages each. All ranks name the same arguments, twelve at most. The
/// messages that follow may depend on them.
void agree(Participant& self, std::initializer_list<Shared> arguments = {});

/// As above. Gives ranks that need no argument the value of the others, or 0.
void agree(Participant& self, std::span<Shared> arguments);

/// As agree(), but returns the number of the first of `arguments` that differs, or their number.
std::size_t find_difference(Participant& self, std::span<Shared> arguments);

/// Throws on every rank the Error of an argument that differs between ranks. Collective.
[[noreturn]] void refuse(const Shared& argument, Participant& self);

/// Throws on every rank the failure of `failing_rank`; does nothing for no_rank.
///
/// Collective if it throws: one broadcast, and agree() before it for some_rank. All ranks pass the
/// same number.
void fail_together(int failing_rank, Participant& self);

}  // namespace rrcb
