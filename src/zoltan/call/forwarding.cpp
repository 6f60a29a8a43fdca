#include "zoltan/call/forwarding.hpp"

#include "cuts/cut_limits.hpp"
#include "zoltan/real/message.hpp"

#include <array>
#include <atomic>
#include <cstdio>

namespace rrcb::zoltan {

namespace {

/// Returns a setting that RRCB leaves to Zoltan's RCB; null if there is none.
const char* forwarded_setting(const Parameters& parameters) {
    if (parameters.weight_dimension > 1) return "OBJ_WEIGHT_DIM is above 1";
    if (parameters.reduce_dimensions != 0) return "REDUCE_DIMENSIONS is set";
    // RRCB's own limits decide the places of cuts.
    if (parameters.average_cuts != 0 && !are_cuts_limited(parameters.options))
        return "AVERAGE_CUTS is set";
    return nullptr;
}

}  // namespace

bool forwards(const Parameters& parameters) {
    return forwarded_setting(parameters) != nullptr;
}

void print_forwarding(const State& state, const char* function) noexcept {
    static std::atomic<bool> is_printed = false;
    if (state.communicator->rank() != 0 || state.parameters.debug_level <= 0) return;
    if (is_printed.exchange(true)) return;
    std::array<char, 128> text{};
    std::snprintf(text.data(), text.size(), "Zoltan's RCB answers this call and its look-ups: %s",
                  forwarded_setting(state.parameters));
    print_warning(0, function, text.data());
}

}  // namespace rrcb::zoltan
