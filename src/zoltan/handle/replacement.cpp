#include "zoltan/handle/replacement.hpp"

#include "zoltan/real/message.hpp"

#include <cstdlib>
#include <new>
#include <string>

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

/// A method that users may expect to be replaced, and the reason why Zoltan still answers for it.
struct Left {
    const char* method;
    bool in_hier_only;
    const char* reason;
};
constexpr Left left_methods[] = {
    {"RIB", false, "LB_METHOD=RIB stays Zoltan's; RRCB_REPLACE replaces RCB alone"},
    {"HSFC", false, "LB_METHOD=HSFC stays Zoltan's; RRCB_REPLACE replaces RCB alone"},
    {"RCB", true,
     "RCB inside HIER stays Zoltan's; the callback for HIER's methods can set RRCB by name"},
};

}  // namespace

std::string method_of(const State& state) {
    const std::string* given = state.parameters.given.find("LB_METHOD");
    return given == nullptr ? "RCB" : clean(given->c_str());
}

InsideZoltan::InsideZoltan(const State* outer) noexcept
    : outer_before_(outer_state), inside_before_(inside) {
    outer_state = outer;
    inside = true;
}

InsideZoltan::~InsideZoltan() {
    outer_state = outer_before_;
    inside = inside_before_;
}

bool is_replacement_asked() {
    static const bool is_asked = read_environment();
    return is_asked;
}

Parameters initial_parameters() {
    Parameters parameters;
    if (!inside) return parameters;
    parameters.remap = 0;
    if (outer_state != nullptr) {
        parameters.weight_dimension = outer_state->parameters.weight_dimension;
        parameters.debug_level = outer_state->parameters.debug_level;
    }
    return parameters;
}

bool is_inside_hier() {
    return outer_state != nullptr &&
           (outer_state->inside_hier || method_of(*outer_state) == "HIER");
}

void replace_rcb(State& state) noexcept {
    state.replacement_asked = true;
    state.parameters.replace_rcb = !inside;
    state.parameters.rrcb = !inside;
}

void tell_if_not_replaced(const State* state, const char* function) noexcept try {
    if (state == nullptr || !state->replacement_asked) return;
    const State& programs = outer_state == nullptr ? *state : *outer_state;
    if (programs.parameters.debug_level <= 0) return;
    const std::string method = method_of(*state);
    for (const Left& left : left_methods)
        if (method == left.method && (!left.in_hier_only || state->inside_hier))
            warn_once(programs.communicator->rank(), function, left.reason);
} catch (const std::bad_alloc&) {
    // Without memory only the notice is lost.
}

}  // namespace rrcb::zoltan
