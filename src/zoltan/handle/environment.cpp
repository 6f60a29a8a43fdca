#include "zoltan/handle/environment.hpp"

#include "zoltan/real/message.hpp"

#include <cstdlib>
#include <mutex>
#include <set>

namespace rrcb::zoltan {

namespace {

constexpr const char* tolerance_name = "RRCB_IMBALANCE_TOL";

/// Returns whether this is the first handle of this process with the setting.
bool is_first(const std::string& setting) {
    static std::mutex mutex;
    static auto& met = *new std::set<std::string>;
    const std::scoped_lock lock(mutex);
    return met.insert(setting).second;
}

void warn_once(const State& state, const char* name, const char* value) {
    if (state.communicator->rank() != 0) return;
    const std::string text = std::string("illegal value `") + value + "' of " + name +
                             " in the environment; default value will be used.";
    if (is_first(text)) print_warning(0, "Zoltan_Create", text);
}

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
            warn_once(state, name, value);
        } else if (belongs_to_calls(name)) {
            state.parameters.given.note(program_name_of(name), value);
        }
    }
}

}  // namespace rrcb::zoltan
