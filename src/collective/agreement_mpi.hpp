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
/// The Error is that of the lowest rank whose failure no other failure caused; if there is none,
/// that of the lowest failing rank. All ranks pass the same arguments, twelve at most; messages
/// after agree() may depend on their values.
///
/// Collective: one reduction. In the meeting of a call it sends R - 1 messages up the MergeTree and
/// R - 1 in a broadcast instead.
void agree(Participant& self, std::initializer_list<Shared> arguments = {});

/// As above. On ranks that do not need an argument, it is set to the value of the others, or to 0.
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
