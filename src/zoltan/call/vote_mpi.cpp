#include "zoltan/call/vote_mpi.hpp"

#include "collective/communicator.hpp"
#include "options/request.hpp"
#include "zoltan/call/fortran_mpi.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace rrcb::zoltan {

namespace {

/// Codes in ascending order of severity. The most severe code of all ranks is returned.
constexpr std::array codes = {ZOLTAN_OK, ZOLTAN_WARN, ZOLTAN_FATAL, ZOLTAN_MEMERR};

int severity(int code) {
    for (std::size_t i = 0; i < codes.size(); ++i) {
        if (codes[i] == code) return static_cast<int>(i);
    }
    return severity(ZOLTAN_FATAL);
}

/// Returns true for options that are parameters, except the number of parts, on which the ranks
/// agree separately, and options that the balancer itself compares.
constexpr bool is_voted_on(const Option& option) {
    return option.parameter[0] != '\0' && is_compared(option) &&
           std::string_view(option.name) != "num_parts";
}

constexpr std::size_t num_shared =
    static_cast<std::size_t>(std::ranges::count_if(option_table, is_voted_on)) +
    static_cast<std::size_t>(std::ranges::count_if(
        parameter_table, [](const ParameterRow& row) { return row.compared.has_value(); }));

/// Calls visit(name, value) for each parameter that must be the same on every rank.
template <class Visit>
void for_each_shared(const Parameters& parameters, Visit&& visit) {
    for (const ParameterRow& row : parameter_table)
        if (row.compared) visit(row.name, (*row.compared)(parameters));
    for (const Option& option : option_table)
        if (is_voted_on(option))
            visit(option.parameter, number_of(bits_of(option, parameters.options)));
}

/// Numbers of one rank in the vote, which are reduced by their maximum. A minimum is sent as the
/// maximum of the complement.
struct Ballot {
    int severity = 0;
    int failing_rank_from_last = 0;  ///< number of ranks minus lowest failing rank
    int num_global_parts = -1;
    int return_lists = 0;
    int complement_of_return_lists = 0;
    Votes votes{};
    int dumping_rank_from_last = 0;  ///< number of ranks minus lowest rank with a folder for dumps
    int dump_always = 0;
    std::array<int, num_shared> largest{};
    std::array<int, num_shared> complement_of_smallest{};
};

Ballot ballot_of(const LocalStatus& local, const State& state) {
    const Parameters& parameters = state.parameters;
    Ballot ballot;
    ballot.severity = severity(local.code);
    if (local.code != ZOLTAN_OK && local.code != ZOLTAN_WARN) {
        ballot.failing_rank_from_last = state.communicator->size() - state.communicator->rank();
    }
    ballot.num_global_parts = asked_global_parts(state);
    ballot.return_lists = static_cast<int>(parameters.return_lists);
    ballot.complement_of_return_lists = ~ballot.return_lists;
    ballot.votes = {.any_local_parts = parameters.num_local_parts >= 0,
                    .any_part_sizes = !state.part_sizes.empty(),
                    .any_fortran = is_fortran_used(),
                    .any_lacks_cuts = !state.last,
                    .any_changed_axes = state.axes_changed,
                    .any_may_not_keep = !local.may_keep,
                    .any_names_parts = local.names_parts};
    if (!parameters.dump_folder.empty()) {
        ballot.dumping_rank_from_last = state.communicator->size() - state.communicator->rank();
        ballot.dump_always = parameters.dump_always ? 1 : 0;
    }
    std::size_t i = 0;
    for_each_shared(parameters, [&](const char*, int value) {
        ballot.largest[i] = value;
        ballot.complement_of_smallest[i++] = ~value;
    });
    return ballot;
}

}  // namespace

Outcome vote(const LocalStatus& local, const State& state) {
    Ballot ballot = ballot_of(local, state);
    static_assert(sizeof(Ballot) % sizeof(int) == 0);
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, &ballot, sizeof(Ballot) / sizeof(int), MPI_INT, MPI_MAX,
                             state.communicator->get()),
               "MPI_Allreduce");
    Outcome outcome;
    static_cast<Votes&>(outcome) = ballot.votes;
    outcome.code = codes[ballot.severity];
    outcome.failing_rank = state.communicator->size() - ballot.failing_rank_from_last;
    outcome.num_global_parts = ballot.num_global_parts;
    outcome.return_lists = static_cast<ReturnLists>(ballot.return_lists);
    outcome.lists_differ = ballot.return_lists != ~ballot.complement_of_return_lists;
    if (ballot.dumping_rank_from_last > 0)
        outcome.dump.rank = state.communicator->size() - ballot.dumping_rank_from_last;
    outcome.dump.always = ballot.dump_always != 0;
    std::size_t i = 0;
    for_each_shared(state.parameters, [&](const char* name, int) {
        const bool differs = ballot.largest[i] != ~ballot.complement_of_smallest[i];
        if (differs && outcome.differing == nullptr) outcome.differing = name;
        ++i;
    });
    return outcome;
}

}  // namespace rrcb::zoltan
