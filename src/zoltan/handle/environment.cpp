#include "zoltan/handle/environment.hpp"

#include "zoltan/real/message.hpp"

#include <cstdlib>

namespace rrcb::zoltan {

namespace {

constexpr const char* tolerance_name = "RRCB_IMBALANCE_TOL";

bool set(Parameters& parameters, const char* name, const char* value) {
    if (name == tolerance_name) return set_tolerance(parameters, value);
    return set_own(parameters, name, value) == Setting::accepted;
}

/// Returns the name under which a program sets the parameter.
const char* program_name_of(const char* name) {
    return name == tolerance_name ? "IMBALANCE_TOL" : name;
}

/// Returns whether a parameter belongs to calls. Copies of a handle and replayed calls need all
/// except the folder of dumps.
bool belongs_to_calls(std::string_view name) {
    return !name.starts_with("RRCB_DUMP");
}

}  // namespace

void read_environment(State& state) {
    std::vector<const char*> names = own_parameter_names();
    names.push_back(tolerance_name);
    for (const char* name : names) {
        const char* value = std::getenv(name);
        if (value == nullptr || *value == '\0') continue;
        if (!set(state.parameters, name, value)) {
            warn_once(state.communicator->rank(), "Zoltan_Create",
                      std::string("illegal value `") + value + "' of " + name +
                          " in the environment; default value will be used.");
        } else if (belongs_to_calls(name)) {
            state.parameters.given.note(program_name_of(name), value);
        }
    }
}

}  // namespace rrcb::zoltan
