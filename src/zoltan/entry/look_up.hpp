#pragma once

#include "zoltan/entry/entry_point.hpp"

#include <string>

namespace rrcb::zoltan {

/// Returns the state of a handle whose look-ups RRCB answers; null if the real Zoltan has to
/// answer.
inline const State* look_up_state(const Zoltan_Struct* zz) {
    const State* state = rrcb_state(zz);
    return state != nullptr && !state->zoltan_has_cuts ? state : nullptr;
}

/// Runs a look-up in the last partition, in the way of guarded(). It fails if no cuts were kept.
template <typename Body>
int look_up(const char* function, const State& state, Body body) noexcept {
    return guarded(function, &state, [&] {
        if (!state.last || !state.last->answers_look_ups())
            throw_fatal("No Decomposition Data available; use KEEP_CUTS parameter.");
        body(*state.last);
        return ZOLTAN_OK;
    });
}

/// Throws ZoltanError unless part p is on rank p for every p, which calls without parts require.
inline void require_one_part_per_rank(const PartMap& map, const char* alternative) {
    if (map.one_each) return;
    throw_fatal(
        std::string("Non-uniform distribution of parts over processors is specified; use ") +
        alternative);
}

}  // namespace rrcb::zoltan
