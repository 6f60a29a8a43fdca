#include "partition_mpi.hpp"

#include "agreement_mpi.hpp"
#include "dump_mpi.hpp"
#include "failure.hpp"
#include "layout_mpi.hpp"
#include "lists_mpi.hpp"
#include "message.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>

#include <new>
#include <string>
#include <utility>

namespace rrcb::zoltan {

namespace {

void check_parameters(const State& state, bool one_part_per_rank) {
    const Parameters& parameters = state.parameters;
    if (parameters.weight_dimension > 1) {
        throw Failure(ZOLTAN_FATAL, "RRCB balances one weight per object; OBJ_WEIGHT_DIM is " +
                                        std::to_string(parameters.weight_dimension));
    }
    if (parameters.return_lists == ReturnLists::candidates) {
        throw Failure(ZOLTAN_FATAL, "RRCB makes no candidate lists; change RETURN_LISTS");
    }
    const int global = parameters.num_global_parts;
    const int local = parameters.num_local_parts;
    const bool other_global = global != -1 && global != state.communicator->size();
    if (one_part_per_rank && (other_global || (local != -1 && local != 1))) {
        throw Failure(ZOLTAN_FATAL,
                      "Zoltan_LB_Balance makes one part per rank; use Zoltan_LB_Partition for "
                      "other NUM_GLOBAL_PARTS or NUM_LOCAL_PARTS");
    }
}

/// Everything one rank does alone, errors and foreign exceptions included.
LocalStatus collect(Zoltan_Struct* zz, State& state, bool one_part_per_rank, Objects& objects) {
    try {
        check_parameters(state, one_part_per_rank);
        objects = collect_objects(zz, state.parameters, state.workspace);
        return {objects.warned ? ZOLTAN_WARN : ZOLTAN_OK, ""};
    } catch (const Failure& failure) {
        return {failure.code(), failure.what()};
    } catch (const std::bad_alloc&) {
        return {ZOLTAN_MEMERR, "out of memory for the objects"};
    } catch (const std::exception& thrown) {
        return {ZOLTAN_FATAL, std::string("a callback threw: ") + thrown.what()};
    } catch (...) {
        return {ZOLTAN_FATAL, "a callback threw"};
    }
}

Options options_for(const State& state, const Layout& layout) {
    Options options = state.parameters.options;
    options.num_parts = layout.map.num_parts();
    options.part_sizes = layout.part_sizes;
    return options;
}

/// Messages and code for what is legal but not as good as it was asked for.
int review(const Report& report, const State& state, const char* function) {
    std::string text;
    if (report.all_weights_zero) text = "all weights are zero; balanced by number of objects";
    if (report.num_points > 0 && report.surplus_parts > 0) {
        text = std::to_string(report.surplus_parts) +
               " parts stay empty: there are more parts than objects";
    }
    if (text.empty()) return ZOLTAN_OK;
    if (state.communicator->rank() == 0 && state.parameters.debug_level > 0) {
        print_warning(0, function, text);
    }
    return ZOLTAN_WARN;
}

/// Drops or completes the lists as RETURN_LISTS asks.
void select_lists(Zoltan_Struct* zz, ReturnLists asked, Partition& result) {
    constexpr int not_asked = -1;
    if (!result.changes) return;
    if (asked == ReturnLists::all || asked == ReturnLists::imports) {
        result.imports = invert(zz, result.exports);
    } else {
        result.imports.count = not_asked;
    }
    if (asked == ReturnLists::imports || asked == ReturnLists::none) {
        result.exports = List{};
        result.exports.count = not_asked;
    }
}

int migrate(Zoltan_Struct* zz, const Partition& result) {
    const List& imports = result.imports;
    const List& exports = result.exports;
    return Zoltan_Migrate(zz, imports.count, imports.global_ids.get(), imports.local_ids.get(),
                          imports.ranks.get(), imports.parts.get(), exports.count,
                          exports.global_ids.get(), exports.local_ids.get(), exports.ranks.get(),
                          exports.parts.get());
}

int balance_objects(Zoltan_Struct* zz, State& state, const Agreement& agreement, Objects&& objects,
                    const char* function, Partition& result) {
    const Communicator& comm = *state.communicator;
    const Parameters& parameters = state.parameters;
    Layout layout = make_layout(agreement, state);
    Balance balanced = balance(objects.points, options_for(state, layout), comm.get());
    if (parameters.return_lists == ReturnLists::none) {
        result.changes = true;
    } else {
        Exports exports =
            make_exports(std::move(objects), parameters, balanced.parts, layout.map, comm.rank());
        result.exports = std::move(exports.list);
        result.changes = any_rank(exports.moves, comm.get());
    }
    select_lists(zz, parameters.return_lists, result);
    if (parameters.keep_cuts != 0) {
        state.kept = Kept{std::move(balanced.cuts), std::move(layout.map)};
    }
    const int code = review(balanced.report, state, function);
    if (parameters.auto_migrate == 0 || !result.changes) return code;
    const int migrated = migrate(zz, result);
    return migrated == ZOLTAN_OK ? code : migrated;
}

}  // namespace

int partition(Zoltan_Struct* zz, State& state, const char* function, bool one_part_per_rank,
              Partition& result) {
    const int rank = state.communicator->rank();
    state.kept.reset();
    Objects objects;
    const LocalStatus local = collect(zz, state, one_part_per_rank, objects);
    const Agreement agreement = agree(local, state);
    dump(DumpReason::asked, agreement, state, {function, objects, local});
    if (agreement.failed()) {
        dump(DumpReason::failure, agreement, state, {function, objects, local});
        if (rank == agreement.failing_rank) print_error(rank, function, local.text);
        return agreement.code;
    }
    const auto fail_everywhere = [&](int code, const std::string& text) {
        if (rank == 0) print_error(rank, function, text);
        dump(DumpReason::failure, agreement, state, {function, objects, {code, text}});
        result = Partition{};
        return code;
    };
    if (!agreement.differing.empty()) {
        return fail_everywhere(ZOLTAN_FATAL, "parameter " + agreement.differing +
                                                 " differs between ranks; set the same value on "
                                                 "all of them");
    }
    try {
        const int code =
            balance_objects(zz, state, agreement, std::move(objects), function, result);
        return code == ZOLTAN_OK ? agreement.code : code;
    } catch (const Failure& failure) {
        return fail_everywhere(failure.code(), failure.what());
    } catch (const Error& error) {
        result = Partition{};
        // An error of MPI's may be this rank's alone; nothing more can be done together.
        if (error.code() == ErrorCode::mpi) throw;
        const bool memory = error.code() == ErrorCode::out_of_memory;
        return fail_everywhere(memory ? ZOLTAN_MEMERR : ZOLTAN_FATAL, error.what());
    }
}

}  // namespace rrcb::zoltan
