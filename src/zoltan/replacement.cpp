#include "replacement.hpp"

#include "message.hpp"

#include <cstdlib>

namespace rrcb::zoltan {

namespace {

thread_local const State* outer_state = nullptr;
thread_local bool inside = false;

bool read_environment() {
    const char* value = std::getenv("RRCB_REPLACE");
    if (value == nullptr || *value == '\0') return false;
    if (clean(value) == "RCB") return true;
    print_warning(-1, "RRCB_REPLACE", "only RCB can be replaced; the variable is ignored");
    return false;
}

bool replaces_rcb() {
    static const bool replaces = read_environment();
    return replaces;
}

}  // namespace

InsideZoltan::InsideZoltan(const State* outer) noexcept
    : outer_before_(outer_state), inside_before_(inside) {
    outer_state = outer;
    inside = true;
}

InsideZoltan::~InsideZoltan() {
    outer_state = outer_before_;
    inside = inside_before_;
}

Parameters initial_parameters() {
    Parameters parameters;
    if (!inside) {
        parameters.replace_rcb = replaces_rcb();
        parameters.rrcb = parameters.replace_rcb;
        return parameters;
    }
    parameters.remap = 0;
    if (outer_state != nullptr) {
        parameters.weight_dimension = outer_state->parameters.weight_dimension;
        parameters.debug_level = outer_state->parameters.debug_level;
    }
    return parameters;
}

}  // namespace rrcb::zoltan
