#include "zoltan/handle/environment.hpp"

#include "zoltan/real/message.hpp"

#include <cstdlib>

namespace rrcb::zoltan {

namespace {

/// Sets a parameter to the value of an environment variable, if that is set.
void read_variable(const char* variable, const std::string& name, State& state) {
    const char* value = std::getenv(variable);
    if (value == nullptr || *value == '\0') return;
    Parameters& parameters = state.parameters;
    const Setting setting = set_own(parameters, name, value);
    const bool is_set = setting == Setting::unknown ? set_tolerance(parameters, value)
                                                    : setting == Setting::accepted;
    if (!is_set) {
        warn_once(state.communicator->rank(), "Zoltan_Create",
                  std::string("illegal value `") + value + "' of " + variable +
                      " in the environment; default value will be used.");
    } else if (!name.starts_with("RRCB_DUMP")) {
        // Copies of a handle and replayed calls need this parameter. Only the folder of dumps is
        // left out.
        parameters.given.note(name, value);
    }
}

}  // namespace

void read_environment(State& state) {
    for (const char* name : own_parameter_names()) read_variable(name, name, state);
    read_variable("RRCB_IMBALANCE_TOL", "IMBALANCE_TOL", state);
}

}  // namespace rrcb::zoltan
