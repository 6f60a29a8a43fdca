#include "zoltan/call/call_log_mpi.hpp"
#include "zoltan/call/fortran_mpi.hpp"
#include "zoltan/call/partition_mpi.hpp"
#include "zoltan/call/rcb_options.hpp"
#include "zoltan/entry/entry_point.hpp"
#include "zoltan/handle/create_mpi.hpp"
#include "zoltan/handle/replacement.hpp"
#include "zoltan/real/real_zoltan.hpp"

#include <chrono>
#include <string>
#include <utility>

using namespace rrcb::zoltan;

namespace {

/// Switches a handle to RRCB. Switches the real Zoltan to RCB, which answers the calls that RRCB
/// leaves to it.
template <typename SwitchZoltan>
int switch_to_rrcb(State& state, SwitchZoltan switch_zoltan) {
    if (state.deserialized)
        throw_fatal(
            "a handle filled by Zoltan_Deserialize cannot be switched to RRCB; create "
            "one with Zoltan_Create");
    // Zoltan is switched only once, because it frees its cuts even if its method does not change.
    const int code = state.parameters.rrcb ? ZOLTAN_OK : switch_zoltan();
    if (code == ZOLTAN_OK) state.parameters.rrcb = true;
    return code;
}

int reject_value(const State& state, const std::string& name, const std::string& value) {
    print_warning(
        state.communicator->rank(), "Zoltan_Set_Param",
        "Invalid value `" + value + "' for parameter `" + name + "'; the previous value is kept.");
    return ZOLTAN_WARN;
}

/// Returns whether Zoltan_Set_Param has set the parameter if it returned this code. For an unknown
/// value of RETURN_LISTS Zoltan warns, but sets the default.
bool is_taken(const std::string& name, int code) {
    return code == ZOLTAN_OK || name == "RETURN_LISTS";
}

/// Sets a parameter of the plug-in, or lets forward_value() set one of Zoltan.
template <typename Forward>
int set_parameter(State& state, const std::string& name, const char* raw_value,
                  Forward forward_value) {
    const std::string value = clean(raw_value);
    if (name == "LB_METHOD" && without_trailing_blanks(value) == "RRCB")
        return switch_to_rrcb(state, [&] { return forward_value("RCB"); });
    const Setting setting = set_own(state.parameters, name, raw_value);
    if (setting == Setting::accepted) return ZOLTAN_OK;
    if (setting == Setting::refused) return reject_value(state, name, value);
    const int code = forward_value(raw_value);
    if (is_taken(name, code)) note_common(state.parameters, name, value);
    if (state.deserialized) state.parameters.rrcb = false;
    return code;
}

/// Notes that a parameter was set. If its value has changed, the next partition may differ from the
/// last one.
void note_change(State& state, const std::string& name, const char* raw_value) {
    if (!state.parameters.given.note(name, raw_value)) return;
    // These two affect which results are returned, but not the parts.
    if (name != "RETURN_LISTS" && name != "KEEP_CUTS") state.kept.reset();
    if (chooses_axes(name)) state.axes_changed = true;
}

int set_parameter(Zoltan_Struct* zz, const char* raw_name, const char* raw_value, int index) {
    State* state = find_state(zz);
    const auto forward_value = [&](const char* value) {
        return forward<&RealZoltan::set_param_vec>(zz, raw_name, value, index);
    };
    if (state == nullptr) return forward_value(raw_value);
    return guarded("Zoltan_Set_Param", state, [&] {
        std::string name = clean(raw_name);
        const int code = set_parameter(*state, name, raw_value, forward_value);
        if (index >= 0) name += '[' + std::to_string(index) + ']';
        if (is_taken(name, code)) note_change(*state, name, raw_value);
        if (!state->parameters.rrcb) {
            state->last.reset();
            state->zoltan_has_cuts = false;
        }
        return code;
    });
}

void hand_out(List&& list, bool with_caller, const CallerList& to) {
    *to.count = list.count;
    // Only lists with entries can be in the caller's variables already.
    if (with_caller && list.count > 0) return;
    *to.global_ids = as_zoltan_ids(list.global_ids.release());
    *to.local_ids = as_zoltan_ids(list.local_ids.release());
    *to.ranks = list.ranks.release();
    if (to.parts != nullptr) *to.parts = list.parts.release();
}

/// A call of one of the partitioning functions.
struct Request {
    Zoltan_Struct* zz;
    const char* function;
    bool one_part_per_rank;
};

/// Lets the real Zoltan answer by forward_it(), even if the handle belongs to RRCB.
template <typename Forward>
int let_zoltan_answer(const Request& request, Forward forward_it) {
    State* state = find_state(request.zz);
    tell_if_not_replaced(state, request.function);
    const InsideZoltan inside(state);
    const int code = forward_it();
    if (state != nullptr && state->parameters.rrcb)
        state->zoltan_has_cuts =
            keeps_cuts(state->parameters) && (code == ZOLTAN_OK || code == ZOLTAN_WARN);
    return code;
}

/// Partitions with RRCB. If the call is left to the real Zoltan, lets that answer by forward_it().
template <typename Forward>
int answer(const Request& request, const CallerLists& to, Forward forward_it) {
    State* state = rrcb_state(request.zz);
    if (state == nullptr) return let_zoltan_answer(request, forward_it);
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    Partition result;
    const int code = guarded(request.function, state, [&] {
        return partition(request.zz, *state, request.function, request.one_part_per_rank, to,
                         result);
    });
    if (result.is_zoltans) return let_zoltan_answer(request, forward_it);
    log_call(*state, result, std::chrono::duration<double>(Clock::now() - start).count());
    *to.changes = result.changes ? 1 : 0;
    *to.num_gid_entries = state->parameters.num_gid_entries;
    *to.num_lid_entries = state->parameters.num_lid_entries;
    hand_out(std::move(result.imports), result.with_caller, to.imports);
    hand_out(std::move(result.exports), result.with_caller, to.exports);
    return code;
}

/// Sets the name of the default method, which Zoltan_Create of Zoltan 13.2 leaves uninitialized
/// although Zoltan_Serialize needs it. DEBUG_LEVEL is 0 meanwhile, because at level 1, the default,
/// Zoltan would print the name.
void name_method(Zoltan_Struct* zz) {
    constexpr int no_index = -1;
    forward<&RealZoltan::set_param_vec>(zz, "DEBUG_LEVEL", "0", no_index);
    forward<&RealZoltan::set_param_vec>(zz, "LB_METHOD", "RCB", no_index);
    forward<&RealZoltan::set_param_vec>(zz, "DEBUG_LEVEL", "1", no_index);
}

}  // namespace

RRCB_EXPORT Zoltan_Struct* Zoltan_Create(MPI_Comm user) {
    Zoltan_Struct* zz = forward<&RealZoltan::create>(user);
    if (zz == nullptr || user == MPI_COMM_NULL) return zz;
    name_method(zz);
    // Without a state the handle is Zoltan's own. Zoltan refuses LB_METHOD=RRCB for it, so the
    // program gets an error.
    bool is_everywhere = true;
    guarded("Zoltan_Create", nullptr, [&] {
        is_everywhere = create_state(zz, user);
        return ZOLTAN_OK;
    });
    return is_everywhere ? zz : nullptr;
}

RRCB_EXPORT Zoltan_Struct* Zoltan_Copy(Zoltan_Struct const* from) {
    Zoltan_Struct* copy = forward<&RealZoltan::copy>(from);
    if (copy == nullptr) return copy;
    const int code = guarded("Zoltan_Copy", find_state(from), [&] {
        copy_state(copy, from);
        return ZOLTAN_OK;
    });
    // A copy without the state could not be used with RRCB.
    if (code != ZOLTAN_OK) Zoltan_Destroy(&copy);
    return copy;
}

RRCB_EXPORT int Zoltan_Copy_To(Zoltan_Struct* to, Zoltan_Struct const* from) {
    const int code = forward<&RealZoltan::copy_to>(to, from);
    if (code != ZOLTAN_OK) return code;
    return guarded("Zoltan_Copy_To", find_state(from), [&] {
        copy_state(to, from);
        return ZOLTAN_OK;
    });
}

RRCB_EXPORT void Zoltan_Destroy(Zoltan_Struct** zz) {
    if (*zz != nullptr) remove_state(*zz);
    if (const RealZoltan* real = real_zoltan()) real->destroy(zz);
}

RRCB_EXPORT int Zoltan_Set_Param(Zoltan_Struct* zz, const char* name, const char* value) {
    return set_parameter(zz, name, value, -1);
}

RRCB_EXPORT int Zoltan_Set_Param_Vec(Zoltan_Struct* zz, const char* name, const char* value,
                                     int index) {
    return set_parameter(zz, name, value, index);
}

RRCB_EXPORT int Zoltan_LB_Partition(
    Zoltan_Struct* zz, int* changes, int* num_gid_entries, int* num_lid_entries, int* num_import,
    ZOLTAN_ID_PTR* import_global_ids, ZOLTAN_ID_PTR* import_local_ids, int** import_procs,
    int** import_to_part, int* num_export, ZOLTAN_ID_PTR* export_global_ids,
    ZOLTAN_ID_PTR* export_local_ids, int** export_procs, int** export_to_part) {
    const CallerLists to{
        changes,
        num_gid_entries,
        num_lid_entries,
        {num_import, import_global_ids, import_local_ids, import_procs, import_to_part},
        {num_export, export_global_ids, export_local_ids, export_procs, export_to_part}};
    return answer({zz, "Zoltan_LB_Partition", false}, to, [&] {
        return forward<&RealZoltan::lb_partition>(
            zz, changes, num_gid_entries, num_lid_entries, num_import, import_global_ids,
            import_local_ids, import_procs, import_to_part, num_export, export_global_ids,
            export_local_ids, export_procs, export_to_part);
    });
}

RRCB_EXPORT int Zoltan_LB_Balance(Zoltan_Struct* zz, int* changes, int* num_gid_entries,
                                  int* num_lid_entries, int* num_import,
                                  ZOLTAN_ID_PTR* import_global_ids, ZOLTAN_ID_PTR* import_local_ids,
                                  int** import_procs, int* num_export,
                                  ZOLTAN_ID_PTR* export_global_ids, ZOLTAN_ID_PTR* export_local_ids,
                                  int** export_procs) {
    const CallerLists to{changes,
                         num_gid_entries,
                         num_lid_entries,
                         {num_import, import_global_ids, import_local_ids, import_procs, nullptr},
                         {num_export, export_global_ids, export_local_ids, export_procs, nullptr}};
    return answer({zz, "Zoltan_LB_Balance", true}, to, [&] {
        return forward<&RealZoltan::lb_balance>(zz, changes, num_gid_entries, num_lid_entries,
                                                num_import, import_global_ids, import_local_ids,
                                                import_procs, num_export, export_global_ids,
                                                export_local_ids, export_procs);
    });
}

RRCB_EXPORT int Zoltan_LB_Set_Part_Sizes(Zoltan_Struct* zz, int global_num, int length,
                                         int* part_ids, int* weight_indices, float* sizes) {
    const int code = forward<&RealZoltan::lb_set_part_sizes>(zz, global_num, length, part_ids,
                                                             weight_indices, sizes);
    State* state = find_state(zz);
    if (state == nullptr || code != ZOLTAN_OK) return code;
    return guarded("Zoltan_LB_Set_Part_Sizes", state, [&] {
        state->kept.reset();
        if (length == -1) state->part_sizes.clear();
        for (int i = 0; i < length; ++i) {
            const int weight = weight_indices == nullptr ? 0 : weight_indices[i];
            state->part_sizes.push_back({part_ids[i], global_num != 0, sizes[i], weight});
        }
        return code;
    });
}

// No public header declares this function; Zoltan's Fortran interface calls it when it is
// initialised.
RRCB_EXPORT void Zoltan_Register_Fort_Malloc(void (*allocate)(), void (*free)(),
                                             void (*set_struct)()) {
    register_fortran(allocate, free, set_struct);
}
