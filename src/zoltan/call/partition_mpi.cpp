#include "zoltan/call/partition_mpi.hpp"

#include "balance_mpi.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "options/validation.hpp"
#include "paper/paper_mpi.hpp"
#include "zoltan/call/fortran_mpi.hpp"
#include "zoltan/call/kept_objects_mpi.hpp"
#include "zoltan/call/layout_mpi.hpp"
#include "zoltan/call/lists_mpi.hpp"
#include "zoltan/call/notices.hpp"
#include "zoltan/call/rcb_options.hpp"
#include "zoltan/call/renumber_mpi.hpp"
#include "zoltan/call/vote_mpi.hpp"
#include "zoltan/dump/dump_mpi.hpp"
#include "zoltan/real/message.hpp"

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

namespace rrcb::zoltan {

namespace {

/// Collects the objects and checks the parameters of this rank. Converts errors and exceptions of
/// callbacks to a status.
LocalStatus collect(Zoltan_Struct* zz, State& state, bool one_part_per_rank, Objects& objects,
                    std::optional<std::uint64_t>& checksum) {
    try {
        check_parameters(state, one_part_per_rank);
        if (forwards(state.parameters)) return {};
        objects = collect_objects(zz, state.parameters, state.workspace);
        const bool asks_for_lists = state.parameters.return_lists != ReturnLists::none;
        if (state.kept && state.last && asks_for_lists)
            checksum = checksum_in_place(objects, *state.last, *state.kept,
                                         state.communicator->rank(), state.workspace.parts);
        LocalStatus status(objects.warned ? ZOLTAN_WARN : ZOLTAN_OK, "");
        status.may_keep = checksum.has_value();
        status.names_parts = objects.names_parts;
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

/// One call of LB_Partition after the vote, with the partition of the call before it.
struct Call {
    Zoltan_Struct* zz;
    State& state;
    const char* function;
    const CallerLists& to;
    const Outcome& outcome;
    std::optional<LastPartition> previous = {};
};

/// Moves the last partition out of the state. If this call fails, the next one must not start from
/// it.
void take_previous(Call& call) {
    call.state.kept.reset();
    call.previous = std::exchange(call.state.last, std::nullopt);
    if (call.outcome.any_lacks_cuts) call.previous.reset();
}

/// Returns true if no object and no parameter has changed on any rank since the last partition.
/// Collective if the objects may be kept: one reduction.
bool are_kept(const Call& call, std::optional<std::uint64_t> here) {
    const State& state = call.state;
    const bool may_keep = !call.outcome.any_may_not_keep && !call.outcome.failed() &&
                          call.outcome.differing == nullptr;
    std::uint64_t checksum = here.value_or(0);
    if (may_keep) add_up(false, checksum, state.communicator->get());
    return may_keep && checksum == state.kept->checksum;
}

/// Options and memory of a call. They are made before the ranks agree for the last time, because no
/// rank may fail alone afterwards.
struct Preparation {
    Options options;
    PaperOptions paper;              ///< used instead of `options` if RRCB_DOMAIN asks for it
    const Cuts* previous = nullptr;  ///< cuts to start from, or null
    std::optional<Renumbering> renumbering;
    std::optional<LastPartition> last;
};

Preparation prepare(const Call& call, const Layout& layout, int dimension, Participant& self) {
    const Parameters& parameters = call.state.parameters;
    const bool fits = call.previous && call.previous->cuts().dimension == dimension &&
                      call.previous->cuts().num_parts == layout.map.num_parts;
    Preparation made;
    if (fits && !call.outcome.any_changed_axes && starts_from_previous(parameters))
        made.previous = &call.previous->cuts();
    const bool locks = fits && call.previous->answers_look_ups();
    const Communicator& comm = *call.state.communicator;
    const Ranks ranks = ranks_of(self);
    self.attempt([&] {
        made.options =
            make_options(parameters, layout, dimension, locks ? &*call.previous : nullptr);
        if (made.previous != nullptr) made.options.expert.tree = made.previous->shape;
        made.options = complete(std::move(made.options), ranks, nullptr);
        if (parameters.paper_domain) made.paper = make_paper_options(parameters, layout);
        made.renumbering.emplace(parameters, layout, call.outcome.any_names_parts,
                                 made.options.expert.tree, comm);
        made.last.emplace(static_cast<std::size_t>(layout.map.num_parts));
    });
    return made;
}

/// Returns true if an object moves on any rank, or if that is not known. Keeps the checksum with
/// which the next call recognizes unchanged objects. Collective unless RETURN_LISTS is NONE: one
/// reduction.
bool may_change(State& state, const Moves& moves, const Points& points,
                std::span<const Part> parts) {
    if (state.parameters.return_lists == ReturnLists::none) return true;
    KeptObjects& kept = state.kept.emplace(KeptObjects{{}, checksum_of(points, parts)});
    return add_up(moves.count() > 0, kept.checksum, state.communicator->get());
}

/// Keeps the cuts, the numbers of the parts and the report for look-ups and for the next call.
void keep(Preparation&& prepared, Balance&& balanced, PartMap&& map, Numbering&& numbering,
          State& state) {
    prepared.last->keep(std::move(balanced.cuts), std::move(map), std::move(numbering));
    prepared.last->answer_look_ups(keeps_cuts(state.parameters));
    state.workspace.parts = std::move(balanced.parts);
    state.last = std::move(prepared.last);
    if (state.kept) state.kept->report = std::move(balanced.report);
    state.axes_changed = false;
}

/// If Zoltan's Fortran interface is used on any rank, copies the lists into the caller's variables;
/// this is then collective.
void serve_fortran(const Call& call, Partition& result, Participant& self) {
    if (!call.outcome.any_fortran) return;
    copy_for_fortran(call.zz, result, IdWidths(call.state.parameters), call.to, self);
    result.with_caller = true;
}

/// Returns true if each part has its own rank and all objects of this rank are in its part; without
/// a callback for parts they are. Not collective.
bool are_in_own_part(const Objects& objects, const PartMap& map, int rank) {
    if (!map.one_each) return false;
    const int* named = objects.initial_parts;
    if (named == nullptr) return true;
    return std::all_of(named, named + objects.count, [&](int part) { return part == rank; });
}

/// Answers a call whose objects remain in the parts of the last partition. Collective in the same
/// cases as serve_fortran().
void keep_objects(const Call& call, Objects&& objects, Partition& result) {
    State& state = call.state;
    if (state.parameters.return_lists == ReturnLists::parts)
        result.exports = list_in_place(std::move(objects), state.communicator->rank());
    Participant self{state.communicator->get()};
    serve_fortran(call, result, self);
    state.last->answer_look_ups(keeps_cuts(state.parameters));
    print_notices(state.kept->report, state.last->map().num_parts, Remap{}, state, call.function);
    result.summary = summary_of(state.kept->report, state.last->map().num_parts);
}

/// Divides the objects by RRCB's own method or by a method of the paper. Collective.
Balance divide(const Call& call, const Layout& layout, const Preparation& prepared,
               const Objects& objects, Participant& self) {
    State& state = call.state;
    if (state.parameters.paper_domain)
        return balance_as_in_paper(objects.points, prepared.paper, self);
    const bool may_keep = are_in_own_part(objects, layout.map, state.communicator->rank());
    return balance(objects.points, prepared.options, prepared.previous, may_keep, self,
                   std::move(state.workspace.parts));
}

/// Divides the objects, and keeps the cuts for the next call. Collective.
void balance_objects(const Call& call, Objects&& objects, Partition& result) {
    const Parameters& parameters = call.state.parameters;
    Participant self{call.state.communicator->get()};
    Layout layout = make_layout(call.outcome, call.state, self);
    Preparation prepared = prepare(call, layout, objects.points.dimension, self);
    Balance balanced = divide(call, layout, prepared, objects, self);
    auto [remap, numbering] = prepared.renumbering->run(objects, balanced.parts, self);
    const Moves moves(objects, balanced.parts, layout.map, call.state.communicator->rank());
    result.changes = may_change(call.state, moves, objects.points, balanced.parts);
    static_cast<Lists&>(result) =
        select_lists(parameters, moves, result.changes, call.state.workspace.records, self);
    serve_fortran(call, result, self);
    self.throw_failed_message();
    print_notices(balanced.report, layout.map.num_parts, remap, call.state, call.function);
    result.summary = summary_of(balanced.report, layout.map.num_parts);
    keep(std::move(prepared), std::move(balanced), std::move(layout.map), std::move(numbering),
         call.state);
}

/// Dumps the inputs of a call, with its code and message so far. Collective as dump().
void dump_inputs(DumpReason reason, const Call& call, const Objects& objects,
                 const LocalStatus& status) {
    dump(reason, call.outcome.dump, call.state,
         {call.function, objects.points, objects.initial_parts, status.code, status.text.data()});
}

/// Makes the call fail in the same way on all ranks; rank `speaker` prints the text. Dumps the
/// inputs, empties the result and returns the code. Collective as dump().
int fail(const Call& call, const Objects& objects, const LocalStatus& status, Partition& result,
         int speaker = 0) {
    if (call.state.communicator->rank() == speaker)
        print_error(speaker, call.function, status.text.data());
    dump_inputs(DumpReason::failure, call, objects, status);
    result = Partition{};
    return status.code;
}

/// Makes the call fail because a parameter differs between ranks.
int refuse_difference(const Call& call, const Objects& objects, Partition& result) {
    std::array<char, 128> text{};
    std::snprintf(text.data(), text.size(),
                  "parameter %s differs between ranks; set the same value on all of them",
                  call.outcome.differing);
    return fail(call, objects, {ZOLTAN_FATAL, text.data()}, result);
}

/// Leaves a call to the real Zoltan. Earlier cuts cannot be used afterwards.
int leave_to_zoltan(const Call& call, Partition& result) {
    print_forwarding(call.state, call.function);
    call.state.last.reset();
    call.state.kept.reset();
    result.is_zoltans = true;
    return ZOLTAN_OK;
}

}  // namespace

int partition(Zoltan_Struct* zz, State& state, const char* function, bool one_part_per_rank,
              const CallerLists& to, Partition& result) {
    Objects objects;
    std::optional<std::uint64_t> checksum;
    const LocalStatus local = collect(zz, state, one_part_per_rank, objects, checksum);
    const Outcome outcome = vote(local, state);
    if (outcome.lists_differ) {
        // The memory for the lists was allocated before the vote, for other lists, so the call
        // starts anew.
        state.parameters.return_lists = outcome.return_lists;
        return partition(zz, state, function, one_part_per_rank, to, result);
    }
    Call call{zz, state, function, to, outcome};
    state.zoltan_has_cuts = false;
    if (!outcome.failed() && outcome.differing == nullptr && forwards(state.parameters))
        return leave_to_zoltan(call, result);
    dump_inputs(DumpReason::asked, call, objects, local);
    const bool is_kept = are_kept(call, checksum);
    if (!is_kept) take_previous(call);
    if (outcome.failed()) {
        fail(call, objects, local, result, outcome.failing_rank);
        return outcome.code;
    }
    if (outcome.differing != nullptr) return refuse_difference(call, objects, result);
    try {
        if (is_kept) {
            keep_objects(call, std::move(objects), result);
            return outcome.code;
        }
        balance_objects(call, std::move(objects), result);
        if (state.parameters.auto_migrate == 0 || !result.changes) return outcome.code;
        const int code = migrate(zz, result);
        return code == ZOLTAN_OK ? outcome.code : code;
    } catch (const ZoltanError& error) {
        return fail(call, objects, {error.code(), error.what()}, result);
    } catch (const Error& error) {
        result = Partition{};
        // An MPI error may have occurred on this rank only, so the ranks cannot fail together.
        if (error.code() == ErrorCode::mpi) throw;
        const bool memory = error.code() == ErrorCode::out_of_memory;
        return fail(call, objects, {memory ? ZOLTAN_MEMERR : ZOLTAN_FATAL, error.what()}, result);
    }
}

}  // namespace rrcb::zoltan
