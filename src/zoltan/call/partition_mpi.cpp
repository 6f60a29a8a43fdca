#include "zoltan/call/partition_mpi.hpp"

#include "balance_mpi.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/butterfly_mpi.hpp"
#include "collective/communicator.hpp"
#include "wide_mpi.hpp"
#include "zoltan/call/fortran_mpi.hpp"
#include "zoltan/call/forwarding.hpp"
#include "zoltan/call/layout_mpi.hpp"
#include "zoltan/call/lists_mpi.hpp"
#include "zoltan/call/look_ups_mpi.hpp"
#include "zoltan/call/notices.hpp"
#include "zoltan/call/rcb_options.hpp"
#include "zoltan/call/renumber_mpi.hpp"
#include "zoltan/call/rest_mpi.hpp"
#include "zoltan/call/vote_mpi.hpp"
#include "zoltan/dump/dump_mpi.hpp"
#include "zoltan/real/message.hpp"
#include "zoltan/real/zoltan_error.hpp"

#include <rrcb/error.hpp>
#include <rrcb/quality.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rrcb::zoltan {

namespace {

/// Result of all that one rank does alone. Errors and foreign exceptions become a status.
LocalStatus collect(Zoltan_Struct* zz, State& state, bool one_part_per_rank, Objects& objects) {
    try {
        check_parameters(state, one_part_per_rank);
        if (forwards(state.parameters)) return {};
        objects = collect_objects(zz, state.parameters, state.workspace);
        LocalStatus status(objects.warned ? ZOLTAN_WARN : ZOLTAN_OK, "");
        status.at_rest = state.rest && state.kept &&
                         state.parameters.return_lists != ReturnLists::none &&
                         is_at_rest(*state.rest, *state.kept, state.parameters, state.workspace,
                                    objects, state.communicator->rank());
        status.is_as_cut = are_as_cut(state, objects);
        return status;
    } catch (const ZoltanError& error) {
        return {error.code(), error.what()};
    } catch (const std::bad_alloc&) {
        return {ZOLTAN_MEMERR, "out of memory for the objects"};
    } catch (const std::exception& thrown) {
        std::array<char, 512> text{};
        std::snprintf(text.data(), text.size(), "a callback threw: %s", thrown.what());
        return {ZOLTAN_FATAL, text.data()};
    } catch (...) {
        return {ZOLTAN_FATAL, "a callback threw"};
    }
}

int migrate(Zoltan_Struct* zz, const Partition& result) {
    const List& imports = result.imports;
    const List& exports = result.exports;
    return Zoltan_Migrate(
        zz, imports.count, as_zoltan_ids(imports.global_ids.get()),
        as_zoltan_ids(imports.local_ids.get()), imports.ranks.get(), imports.parts.get(),
        exports.count, as_zoltan_ids(exports.global_ids.get()),
        as_zoltan_ids(exports.local_ids.get()), exports.ranks.get(), exports.parts.get());
}

/// One call of LB_Partition after the vote, and the partition of the call before it.
struct Call {
    Zoltan_Struct* zz;
    State& state;
    const char* function;
    const CallerLists& to;
    const Outcome& outcome;
    std::optional<KeptPartition> previous = {};
    std::optional<Rest> rest = {};  ///< of the previous partition

    /// Whether nothing has changed on any rank since the last partition.
    bool is_at_rest() const { return outcome.at_rest && outcome.differing == nullptr; }
};

/// Takes the last partition out of the state: should this call fail, the next one must not build on
/// it.
void take_previous(Call& call) {
    call.rest = std::exchange(call.state.rest, std::nullopt);
    call.previous = std::exchange(call.state.kept, std::nullopt);
    if (!call.outcome.all_kept_cuts) call.previous.reset();
}

/// Whether the objects stay where the last partition put them: nothing has changed on any rank, or
/// they lie as its cuts tell and their parts, counted, are even enough. Collective where they are.
bool stays(Call& call) {
    if (call.is_at_rest()) return true;
    State& state = call.state;
    const bool is_even = call.outcome.all_as_cut &&
                         are_even(*call.rest, call.previous->map().num_parts,
                                  state.parameters.skip_within, state.communicator->get());
    if (!is_even) return false;
    state.rest = std::exchange(call.rest, std::nullopt);
    state.kept = std::exchange(call.previous, std::nullopt);
    return true;
}

/// Options and memory of a call, made before the ranks agree for the last time: no rank may fail
/// alone afterwards.
struct Preparation {
    Options options;
    const Cuts* previous = nullptr;  ///< to start from
    std::optional<Renumbering> renumbering;
    std::optional<KeptPartition> kept;
    Rest rest;
    std::optional<ButterflyMessages> messages;
    std::optional<ChecksumSums> checksums;
};

Rest make_rest(const Layout& layout, int dimension, int rank, bool is_spread) {
    Rest rest;
    rest.dimension = dimension;
    rest.own = layout.map.parts_on(rank);
    rest.is_spread = is_spread;
    rest.checksums.resize(static_cast<std::size_t>(rest.own.end - rest.own.first));
    rest.part_sizes = layout.part_sizes;
    rest.part_weights.resize(is_spread ? rest.checksums.size()
                                       : static_cast<std::size_t>(layout.map.num_parts));
    return rest;
}

Preparation prepare(const Call& call, const Layout& layout, const Objects& objects,
                    Participant& self) {
    const Parameters& parameters = call.state.parameters;
    const int dimension = objects.points.dimension;
    const bool fits = call.previous && call.previous->cuts().dimension == dimension &&
                      call.previous->cuts().num_parts == layout.map.num_parts;
    Preparation made;
    if (fits && !call.outcome.axes_changed && starts_from_previous(parameters))
        made.previous = &call.previous->cuts();
    const bool locks = fits && call.previous->answers_look_ups();
    self.attempt([&] {
        made.options =
            make_options(parameters, layout, dimension, locks ? &*call.previous : nullptr);
        const Communicator& comm = *call.state.communicator;
        const bool is_spread = is_wide(made.options, comm.size());
        made.renumbering.emplace(parameters, layout, objects, comm, is_spread);
        made.kept.emplace(static_cast<std::size_t>(layout.map.num_parts), is_spread);
        made.messages.emplace();
        made.checksums.emplace(layout.map, comm, is_spread);
        made.rest = make_rest(layout, objects.points.dimension, comm.rank(), is_spread);
    });
    return made;
}

/// Lists the objects that leave, and tells whether any does on any rank. Sums the checksums by
/// which the next call knows its objects again. Collective unless RETURN_LISTS is NONE.
void list_exports(const Call& call, const Layout& layout, Objects&& objects,
                  const Balance& balanced, Preparation& prepared, Partition& result,
                  Participant& self) {
    const Parameters& parameters = call.state.parameters;
    if (parameters.return_lists == ReturnLists::none) {
        result.changes = true;
        return;
    }
    const std::span<const Part> parts(balanced.parts);
    const Points points = objects.points;
    Exports exports = make_exports(std::move(objects), parameters, parts, layout.map,
                                   call.state.communicator->rank());
    result.exports = std::move(exports.list);
    result.changes = prepared.checksums->run(
        {parameters, call.state.workspace, points, prepared.rest.by_position}, parts, exports.moves,
        layout.map, prepared.rest, *prepared.messages, self);
}

/// Keeps cuts, parts and checksums for the next call.
void keep(Preparation&& prepared, Balance&& balanced, PartMap&& map, Numbering&& numbering,
          State& state) {
    prepared.kept->keep(std::move(balanced.cuts), std::move(map), std::move(numbering));
    prepared.kept->answer_look_ups(keeps_cuts(state.parameters));
    prepared.rest.report = std::move(balanced.report);
    state.kept = std::move(prepared.kept);
    if (state.parameters.return_lists != ReturnLists::none) state.rest = std::move(prepared.rest);
    state.axes_changed = false;
}

/// Puts the lists into the caller's variables where Zoltan's Fortran interface is used on any rank.
/// Collective there.
void serve_fortran(const Call& call, Partition& result, Participant& self) {
    if (!call.outcome.any_fortran) return;
    copy_for_fortran(call.zz, result.imports, result.exports, call.to, self);
    result.with_caller = true;
}

/// Answers a call where the objects stay where the last partition put them. Collective as
/// serve_fortran is.
int stay(const Call& call, Objects&& objects, Partition& result) {
    State& state = call.state;
    if (state.parameters.return_lists == ReturnLists::parts)
        result.exports = list_in_place(std::move(objects), state.communicator->rank());
    Participant self{state.communicator->get()};
    serve_fortran(call, result, self);
    if (!state.kept->shows_all())
        show_all_cuts(call.outcome, state.kept->cuts(), state, *state.kept, self);
    if (call.outcome.any_keeps_cuts && !state.kept->numbering().is_whole())
        state.kept->show_all_numbers(
            whole_numbering(state.kept->numbering(), state.kept->map(), self));
    state.kept->answer_look_ups(keeps_cuts(state.parameters));
    print_notices(state.rest->report, state.kept->map().num_parts, Remap{}, state, call.function);
    result.summary = summary_of(state.rest->report, state.kept->map().num_parts);
    return ZOLTAN_OK;
}

int balance_objects(const Call& call, Objects&& objects, Partition& result) {
    const Parameters& parameters = call.state.parameters;
    Participant self{call.state.communicator->get()};
    Layout layout = make_layout(call.outcome, call.state, self);
    Preparation prepared = prepare(call, layout, objects, self);
    const bool may_stay = are_in_own_part(objects, layout.map, call.state.communicator->rank());
    Balance balanced = balance(objects.points, prepared.options, prepared.previous, may_stay, self);
    auto [remap, numbering] =
        prepared.renumbering->run(layout, objects, balanced.parts, *prepared.messages, self);
    const bool knows_own_parts = is_whole(balanced.cuts) || (remap.identity && layout.map.is_even);
    prepared.rest.by_position = balanced.report.coincident_cuts > 0 || !knows_own_parts;
    list_exports(call, layout, std::move(objects), balanced, prepared, result, self);
    if (prepared.rest.is_spread) agree(self);
    select_lists(parameters, result.changes, self, result.imports, result.exports);
    serve_fortran(call, result, self);
    show_all_cuts(call.outcome, balanced.cuts, call.state, *prepared.kept, self);
    if ((call.outcome.any_keeps_cuts || is_whole(balanced.cuts)) && !numbering.is_whole())
        numbering = whole_numbering(numbering, layout.map, self);
    print_notices(balanced.report, layout.map.num_parts, remap, call.state, call.function);
    result.summary = summary_of(balanced.report, layout.map.num_parts);
    keep(std::move(prepared), std::move(balanced), std::move(layout.map), std::move(numbering),
         call.state);
    return parameters.auto_migrate != 0 && result.changes ? migrate(call.zz, result) : ZOLTAN_OK;
}

/// Dumps the inputs of a call, with its code and message so far. Collective as dump() is.
void dump_inputs(DumpReason reason, const Call& call, const Objects& objects,
                 const LocalStatus& status) {
    dump(reason, call.outcome.dump, call.state,
         {call.function, objects.points, objects.initial_parts.get(), status.code,
          status.text.data()});
}

/// The end of a call that fails on all ranks alike.
struct Failure {
    int code;
    std::string_view text;
    int speaker = 0;  ///< rank that prints the text
};

/// Prints, dumps the inputs and empties the result; returns the code. Collective as dump() is.
int fail(const Call& call, const Objects& objects, const Failure& failure, Partition& result) {
    if (call.state.communicator->rank() == failure.speaker)
        print_error(failure.speaker, call.function, failure.text);
    dump_inputs(DumpReason::failure, call, objects, {failure.code, failure.text});
    result = Partition{};
    return failure.code;
}

/// Fails for a parameter that differs between ranks.
int refuse_difference(const Call& call, const Objects& objects, Partition& result) {
    std::array<char, 128> text{};
    std::snprintf(text.data(), text.size(),
                  "parameter %s differs between ranks; set the same value on all of them",
                  call.outcome.differing);
    return fail(call, objects, {ZOLTAN_FATAL, text.data()}, result);
}

/// Leaves a call to the real Zoltan. The cuts of an earlier one are of no use afterwards.
int leave_to_zoltan(const Call& call, Partition& result) {
    print_forwarding(call.state, call.function);
    call.state.kept.reset();
    call.state.rest.reset();
    result.is_zoltans = true;
    return ZOLTAN_OK;
}

}  // namespace

int partition(Zoltan_Struct* zz, State& state, const char* function, bool one_part_per_rank,
              const CallerLists& to, Partition& result) {
    Objects objects;
    const LocalStatus local = collect(zz, state, one_part_per_rank, objects);
    const Outcome outcome = vote(local, state);
    Call call{zz, state, function, to, outcome};
    state.zoltan_has_cuts = false;
    if (!outcome.failed() && outcome.differing == nullptr && forwards(state.parameters))
        return leave_to_zoltan(call, result);
    if (!call.is_at_rest()) take_previous(call);
    dump_inputs(DumpReason::asked, call, objects, local);
    if (outcome.failed()) {
        fail(call, objects, {local.code, local.text.data(), outcome.failing_rank}, result);
        return outcome.code;
    }
    if (outcome.differing != nullptr) return refuse_difference(call, objects, result);
    try {
        const int code = stays(call) ? stay(call, std::move(objects), result)
                                     : balance_objects(call, std::move(objects), result);
        return code == ZOLTAN_OK ? outcome.code : code;
    } catch (const ZoltanError& error) {
        return fail(call, objects, {error.code(), error.what()}, result);
    } catch (const Error& error) {
        result = Partition{};
        // An error of MPI's may be this rank's alone; nothing more can be done together.
        if (error.code() == ErrorCode::mpi) throw;
        const bool memory = error.code() == ErrorCode::out_of_memory;
        return fail(call, objects, {memory ? ZOLTAN_MEMERR : ZOLTAN_FATAL, error.what()}, result);
    }
}

}  // namespace rrcb::zoltan
