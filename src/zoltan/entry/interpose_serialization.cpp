#include "zoltan/entry/optional_call.hpp"
#include "zoltan/handle/environment.hpp"
#include "zoltan/handle/serialization.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

using namespace rrcb::zoltan;

RRCB_DECLARE_REAL(Zoltan_Serialize_Size)
RRCB_DECLARE_REAL(Zoltan_Serialize)
RRCB_DECLARE_REAL(Zoltan_Deserialize)

namespace {

/// Sets a parameter by its name in `Parameters::given`; an index is part of that name, in brackets.
int set_again(Zoltan_Struct* zz, const std::string& name, const std::string& value) {
    const auto bracket = name.find('[');
    if (bracket == name.npos) return Zoltan_Set_Param(zz, name.c_str(), value.c_str());
    int index = 0;
    std::from_chars(name.data() + bracket + 1, name.data() + name.size(), index);
    return Zoltan_Set_Param_Vec(zz, name.substr(0, bracket).c_str(), value.c_str(), index);
}

/// Returns the value that a parameter has in a new handle.
const char* initial_value_of(std::string_view name) {
    if (name == "LB_METHOD") return "RCB";
    if (name == "REMAP") return "1";
    return name == "RETURN_LISTS" ? "ALL" : "DEFAULT";
}

/// Resets all parameters that a parcel does not contain to their values in a new handle, including
/// those of the real Zoltan.
void reset_others(Zoltan_Struct* zz, const State& state, const Parcel& parcel) {
    GivenParameters others = state.parameters.given;
    // The plug-in does not see it when a buffer of Zoltan sets these two.
    others.note("NUM_GID_ENTRIES", "");
    others.note("NUM_LID_ENTRIES", "");
    for (const auto& [name, value] : others.entries)
        if (parcel.given.find(name) == nullptr) set_again(zz, name, initial_value_of(name));
}

/// Gives the real Zoltan its parameters, part sizes and cuts. Setting these parameters passes
/// through the plug-in again, so its own are set aside meanwhile.
int unpack_zoltans(Zoltan_Struct* zz, State& state, Parcel&& parcel) {
    Parameters parameters = state.parameters;
    parameters.rrcb = true;
    auto* const real = RRCB_REAL(Zoltan_Deserialize, deserialize);
    const int code = real(zz, parcel.of_zoltan.size(), parcel.of_zoltan.data());
    state.parameters = std::move(parameters);
    state.part_sizes = std::move(parcel.part_sizes);
    state.last.reset();
    state.zoltan_has_cuts = code == ZOLTAN_OK;
    return code;
}

/// Gives a handle all parameters of the serialized one.
int unpack(Zoltan_Struct* zz, State& state, Parcel&& parcel) {
    reset_others(zz, state, parcel);
    const bool replace_rcb = state.parameters.replace_rcb;
    state.parameters = Parameters{};
    state.parameters.replace_rcb = replace_rcb;
    read_environment(state);
    state.kept.reset();
    state.deserialized = false;
    Zoltan_LB_Set_Part_Sizes(zz, 1, -1, nullptr, nullptr, nullptr);
    for (const auto& [name, value] : parcel.given.entries) {
        const int code = set_again(zz, name, value);
        if (code != ZOLTAN_OK && code != ZOLTAN_WARN) return code;
    }
    if (!parcel.of_zoltan.empty()) return unpack_zoltans(zz, state, std::move(parcel));
    for (PartSize& entry : parcel.part_sizes) {
        const int code = Zoltan_LB_Set_Part_Sizes(zz, entry.global ? 1 : 0, 1, &entry.part,
                                                  &entry.weight, &entry.size);
        if (code != ZOLTAN_OK && code != ZOLTAN_WARN) return code;
    }
    state.parameters.rrcb = true;
    state.last = std::move(parcel.last);
    state.zoltan_has_cuts = false;
    return ZOLTAN_OK;
}

/// Prints that RRCB no longer replaces Zoltan for a handle of the program, although that was asked
/// for.
void tell_if_left_to_zoltan(const State& state) {
    if (!state.parameters.replace_rcb || state.parameters.debug_level <= 0) return;
    if (state.communicator->rank() != 0) return;
    print_warning(0, "Zoltan_Deserialize",
                  "the buffer is Zoltan's own, so the handle stays with Zoltan's methods");
}

/// Returns a handle as bytes. They contain the bytes of the real Zoltan if that made the last
/// partition.
std::vector<char> pack(const Zoltan_Struct* zz, const State& state) {
    std::vector<char> of_zoltan;
    if (state.zoltan_has_cuts) {
        of_zoltan.resize(RRCB_REAL(Zoltan_Serialize_Size, serialize_size)(zz));
        auto* const real = RRCB_REAL(Zoltan_Serialize, serialize);
        const int code = real(zz, of_zoltan.size(), of_zoltan.data());
        if (code != ZOLTAN_OK) throw ZoltanError(code, "Zoltan's RCB cannot be serialized");
    }
    return serialize(state, of_zoltan);
}

}  // namespace

RRCB_EXPORT size_t Zoltan_Serialize_Size(Zoltan_Struct const* zz) {
    size_t size = 0;
    guarded("Zoltan_Serialize_Size", find_state(zz), [&] {
        const State* state = rrcb_state(zz);
        size = state == nullptr ? RRCB_REAL(Zoltan_Serialize_Size, serialize_size)(zz)
                                : pack(zz, *state).size();
        return ZOLTAN_OK;
    });
    return size;
}

RRCB_EXPORT int Zoltan_Serialize(Zoltan_Struct const* zz, size_t size, char* buffer) {
    return guarded("Zoltan_Serialize", find_state(zz), [&] {
        const State* state = rrcb_state(zz);
        if (state == nullptr) return RRCB_REAL(Zoltan_Serialize, serialize)(zz, size, buffer);
        const std::vector<char> bytes = pack(zz, *state);
        if (bytes.size() > size) throw_fatal("the buffer is too small; ask Zoltan_Serialize_Size");
        std::ranges::copy(bytes, buffer);
        return ZOLTAN_OK;
    });
}

RRCB_EXPORT int Zoltan_Deserialize(Zoltan_Struct* zz, size_t size, char* buffer) {
    State* state = find_state(zz);
    return guarded("Zoltan_Deserialize", state, [&] {
        if (state != nullptr && is_parcel({buffer, size}))
            return unpack(zz, *state, deserialize({buffer, size}));
        auto* const real = RRCB_REAL(Zoltan_Deserialize, deserialize);
        // The buffer was made by the real Zoltan, and replaces every parameter.
        if (state != nullptr) {
            tell_if_left_to_zoltan(*state);
            state->parameters.rrcb = false;
            state->deserialized = true;
            state->last.reset();
            state->zoltan_has_cuts = false;
        }
        return real(zz, size, buffer);
    });
}
