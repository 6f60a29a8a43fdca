#include "balance_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/machines_mpi.hpp"
#include "collective/stamp_access.hpp"
#include "estimate/decision_mpi.hpp"
#include "estimate/earlier_cuts.hpp"
#include "estimate/keeping_mpi.hpp"
#include "lists/duplicated_mpi.hpp"
#include "options/axis_order.hpp"
#include "options/call_kind.hpp"
#include "options/rejection.hpp"
#include "options/request.hpp"
#include "passes/checked_passes.hpp"
#include "passes/host_passes.hpp"
#include "search/settlement_mpi.hpp"
#include "verbose_mpi.hpp"
#include "workspace_mpi.hpp"

#include <algorithm>
#include <optional>
#include <utility>

// A call has these steps:
//   weigh      are the parts of earlier cuts even enough? Then they are kept
//   prepare    checks options and points, reduces the points to cells, allocates all buffers
//   decide     rank 0 bisects the cells of all ranks, unless many ranks make the parts
//   turn?      if the ranks hold a bisection: do cuts across other axes leave far fewer ghosts?
//   keep?      are the parts that the ranks hold even enough?
//   settle     if not, counts of all ranks move the cuts
//   report     imbalance, and the weight of each part
// Only steps before a decision may fail on one rank; all ranks receive that failure with the
// decision.

namespace rrcb {

namespace {

/// Input of a call, which no step changes.
struct Given {
    PointPasses& points;
    const Options& options;
    const Cuts* previous;  ///< earlier cuts, or null
    bool may_keep;
    Ranks ranks;
};

/// Completes and checks the options, and writes what other ranks need to know about them and the
/// points to `mine`. Not collective.
Options introduce(const Given& given, const PointSummary& summary, Contribution& mine,
                  const Participant& self) {
    const int dimension = given.points.dimension();
    Options options = complete(given.options, given.ranks, given.previous);
    check_options(options, dimension);
    const bool spread = is_spread(options, given.ranks.number);
    require(options.expert.tree.round_robin_block == 0 || !spread,
            "tree.round_robin_block must be 0 if many ranks make the parts; raise "
            "max_root_parts");
    if (given.previous) check_previous(*given.previous, options, dimension);
    mine.summary = summarize(summary, given.points.has_weights(), mpi::rank_of(self.comm));
    mine.summary.request = request_of(options, dimension, given.previous);
    Cuts ends{dimension, options.num_parts, {}, options.expert.tree};
    if (given.previous) ends.numbers = given.previous->numbers;
    if (!options.part_sizes.empty())
        for (Part end = 0; end < options.num_parts; ++end)
            options.part_sizes[end] = given.options.part_sizes[ends.part_at(end)];
    if (!spread || !options.part_sizes.empty()) normalize(options.part_sizes, options.num_parts);
    return options;
}

/// Gives every rank the decision of rank 0, or throws the error of one rank on all. Collective.
Report decide_on_all(const Given& given, const Options& options, Contribution& mine,
                     Decision& decision, Participant& self) {
    merge_up(mine, given.points.dimension(), MergeTree{given.ranks.number}, most_cells(options),
             self);
    decide_together(mine, decision, self, [&] { decide(mine, options, decision); });
    given.points.use_weights(!decision.verdict.is_counted());
    return report_of(decision.verdict, options.num_parts, options.part_sizes);
}

/// Replaces the ends of the tree, at which the points are, by the numbers of the parts. Not
/// collective.
void number_parts(const Cuts& cuts, PointPasses& points) {
    if (!cuts.is_numbered_in_order()) points.renumber(numbers_of(cuts));
}

/// Returns true if the parts of earlier cuts have to be weighed, because they may be kept.
bool weighs_earlier(const Given& given) {
    if (!given.previous || given.options.refine == Refine::exact) return false;
    const AxisOrder& order = given.options.expert.axes.order;
    return !is_given(order) || axes_of(given.previous->tree) == axes_in(order);
}

/// Gives the points the parts of the earlier cuts, and adds up the weights of these parts.
/// Collective.
Balance weigh_earlier(const Given& given, Participant& self) {
    Options options;
    Contribution mine;
    Decision decision;
    self.attempt([&] {
        given.points.use_weights(true);
        const PointSummary summary = given.points.summary(are_cuts_limited(given.options));
        options = introduce(given, summary, mine, self);
        take_earlier(decision, options, *given.previous);
        const PartTotals totals = given.points.assign(decision.cuts, true);
        mine.part_totals = totals.weights;
        mine.part_totals.insert(mine.part_totals.end(), totals.counts.begin(), totals.counts.end());
    });
    Balance result{{}, {}, decide_on_all(given, options, mine, decision, self)};
    Report& report = result.report;
    result.cuts = std::move(decision.cuts);
    report_measured(report.imbalance, options.imbalance_tolerance, report);
    if (report.details.num_points == 0) return result;
    report.details.rounds = is_refined(options) ? 1 : 0;
    report.part_weights = std::move(decision.part_weights);
    self.attempt([&] {
        finish_weights(decision.verdict, result.cuts, report.part_weights);
        number_parts(result.cuts, given.points);
    });
    return result;
}

/// Prepares a call that makes cuts. Not collective.
void prepare(const Given& given, Options& options, Contribution& mine, Decision& decision,
             std::optional<Settlement>& settlement, const Participant& self) {
    PointPasses& points = given.points;
    points.use_weights(true);
    const PointSummary summary = points.summary(true);
    options = introduce(given, summary, mine, self);
    const bool spread = is_spread(options, given.ranks.number);
    const bool reads_kept = !spread && reads_kept_tree(options, given.ranks.number);
    decision.earlier = given.previous;
    if (spread && given.previous && !is_given(options.expert.axes.order))
        options.expert.axes.order = AxisOrder::given(axes_of(given.previous->tree));
    settlement.emplace(options, points, reads_kept || given.previous, workspace_of(self.comm).open,
                       self);
    if (spread) {
        if (given.previous) decision.cuts.numbers = given.previous->numbers;
        decision.verdict.answer = Answer::totals;
        return;
    }
    if (reads_kept && given.may_keep) append_extent(summary, points.dimension(), mine.extents);
    make_buffers(decision, options, points.dimension(), reads_kept);
    add_records(points, summary.box, given.ranks.number, options, mine);
}

/// Refines the cuts by counts of all ranks, or only gives the points their parts by unchanged cuts.
/// Collective.
SettledCuts settle(const Given& given, const Box& here, Decision& decision, const Report& report,
                   Settlement& settlement, SettledCuts&& made, Participant& self) {
    const Verdict& verdict = decision.verdict;
    const bool may_keep = verdict.kept_imbalance < not_kept;
    const bool counts = may_keep || given.previous;
    // The message is freed unless it is needed once more, to send kept parts.
    if (!may_keep) decision.message = std::vector<std::byte>();
    const AllPoints all{verdict.num_points,
                        verdict.balanced_weight(),
                        verdict.balanced_heaviest(),
                        verdict.is_counted(),
                        verdict.box,
                        report.details.least_imbalance,
                        verdict.kept_imbalance};
    return settlement.run(all, here, counts, std::move(made), self);
}

/// Makes the settled cuts the result.
void take(SettledCuts&& made, double tolerance, Balance& result) {
    Report& report = result.report;
    result.cuts = std::move(made.cuts);
    report.part_weights = std::move(made.part_weights);
    report.details.rounds = made.rounds;
    report.details.coincident_cuts = made.coincident_cuts;
    report_measured(made.imbalance, tolerance, report);
}

/// Makes the parts that the ranks hold now the result. Collective.
void keep(const Given& given, const Options& options, Decision& decision, Balance& result,
          Participant& self) {
    const bool is_known = decision.verdict.answer == Answer::kept;
    if (is_known) {
        agree(self);
    } else {
        broadcast_kept(decision, self);
    }
    result.cuts = std::move(decision.cuts);
    const Cuts& cuts = result.cuts;
    Report& report = result.report;
    report.kept = is_in_order(cuts, decision.parts);
    report_measured(decision.verdict.kept_imbalance, options.imbalance_tolerance, report);
    report.part_weights = std::move(decision.part_weights);
    // Otherwise the search has counted the cuts that would divide points which are kept together.
    if (is_known || options.expert.coincident == Coincident::divide)
        report.details.coincident_cuts = static_cast<int>(
            std::ranges::count_if(cuts.tree, [](const Cut& cut) { return cut.divides != 0; }));
    const Part part = decision.parts[mpi::rank_of(self.comm)];
    self.attempt([&] { given.points.renumber(std::span(&part, 1)); });
}

/// Gives every rank all cuts, after many ranks have found them, and the weights of all parts.
/// Collective: two reductions.
void complete_cuts(Balance& result, Participant& self) {
    join_cuts(result.cuts.tree, self);
    if (result.report.details.num_points == 0) return result.report.part_weights.clear();
    std::vector<double>& weights = result.report.part_weights;
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, weights.data(), mpi::to_int(std::ssize(weights)),
                             MPI_DOUBLE, MPI_SUM, self.comm),
               "MPI_Allreduce");
}

/// Makes new cuts, across the axes of earlier ones unless other axes are clearly better.
/// Collective.
Balance make_anew(const Given& given, Participant& self) {
    Options options;
    Contribution mine;
    Decision decision;
    std::optional<Settlement> settlement;
    self.attempt([&] { prepare(given, options, mine, decision, settlement, self); });
    const Box here = mine.summary.box;
    Balance result{{}, {}, decide_on_all(given, options, mine, decision, self)};
    SettledCuts made{std::move(decision.cuts), std::move(decision.brackets)};
    const Verdict& verdict = decision.verdict;
    if (verdict.may_turn != 0 && turns(decision, made.cuts, given.points, self)) {
        made = {std::move(decision.turned.cuts), std::move(decision.turned.brackets)};
        result.report.details.estimated_imbalance = verdict.turned_imbalance;
    }
    if (verdict.has_numbers != 0) made.cuts.numbers = std::move(decision.numbers);
    made.cuts.debt = verdict.debt;
    bool is_kept = keeps_at_once(verdict.kept_imbalance, options);
    if (is_kept) {
        decision.cuts = std::move(made.cuts);
    } else {
        made = settle(given, here, decision, result.report, *settlement, std::move(made), self);
        take(std::move(made), options.imbalance_tolerance, result);
        is_kept = verdict.kept_imbalance < not_kept && keeps_after_all(decision, options, result);
        if (is_kept) decision.cuts = std::move(result.cuts);
    }
    if (is_kept) keep(given, options, decision, result, self);
    if (verdict.answer == Answer::totals) complete_cuts(result, self);
    self.attempt([&] {
        const bool has_points = result.report.details.num_points > 0;
        if (given.previous && !has_points) result.cuts = fitted(*given.previous, options);
        finish_weights(verdict, result.cuts, result.report.part_weights);
        number_parts(result.cuts, given.points);
    });
    return result;
}

/// Returns `made`, whose parts the points now have, or `earlier` if `made` is not worth moving
/// points.
Balance better(const Given& given, Balance&& earlier, Balance&& made, Participant& self) {
    made.report.details.rounds += earlier.report.details.rounds;
    if (is_worth_moving(earlier.report, made.report, given.options)) return std::move(made);
    earlier.report.details.rounds = made.report.details.rounds;
    earlier.report.details.coincident_cuts = made.report.details.coincident_cuts;
    earlier.cuts.debt = made.cuts.debt;
    self.attempt([&] {
        given.points.assign(earlier.cuts, false);
        number_parts(earlier.cuts, given.points);
    });
    return std::move(earlier);
}

}  // namespace

Ranks ranks_of(Participant& self) {
    const mpi::Machines machines = mpi::machines_of(self);
    return {mpi::size_of(self.comm), machines.num_ranks, machines.dealt};
}

Balance balance(PointPasses& points, const Options& options, const Cuts* previous, bool may_keep,
                Participant& self) {
    // One part is asked for on each rank, but the cuts were made for another number of ranks.
    const bool are_of_others =
        previous && options.num_parts == 0 && previous->num_parts != mpi::size_of(self.comm);
    const Given given{points, options, are_of_others ? nullptr : previous, may_keep,
                      ranks_of(self)};
    Balance result;
    if (weighs_earlier(given)) result = weigh_earlier(given, self);
    const bool is_weighed = !result.cuts.empty();
    const bool is_kept = is_weighed && result.report.within_tolerance;
    if (!is_kept) {
        Balance made = make_anew(given, self);
        result =
            is_weighed ? better(given, std::move(result), std::move(made), self) : std::move(made);
    }
    detail::StampAccess::ranks(result.cuts.stamp) = mpi::size_of(self.comm) > 1 ? self.group() : 0;
    return result;
}

Balance balance(const Points& points, const Options& options, const Cuts* previous, bool may_keep,
                Participant& self, std::vector<Part> memory) {
    HostPasses host(points, std::move(memory));
    Balance result = balance(host, options, previous, may_keep, self);
    result.parts = host.take_parts();
    detail::StampAccess::points(result.cuts.stamp) =
        hash_if_leaving(points, result.parts, result.cuts.num_parts, mpi::rank_of(self.comm),
                        mpi::size_of(self.comm));
    return result;
}

namespace {

Balance balance_over(MPI_Comm comm, const Points& points, const Options& options,
                     const Cuts& previous, std::vector<Part> memory = {}) {
    Participant self = mpi::enter(comm, CallName::balance);
    const double start = MPI_Wtime();
    Balance result = balance(points, options, given(previous), true, self, std::move(memory));
    print_line(result, options, start, self);
    self.throw_failed_message();
    return result;
}

}  // namespace

Balance balance(const Points& points, MPI_Comm comm, const Options& options, const Cuts& previous) {
    return balance_over(comm, points, options, previous);
}

void balance_into(Balance& result, const Points& points, MPI_Comm comm, const Options& options,
                  const Cuts& previous) {
    result = balance_over(comm, points, options, previous, std::exchange(result.parts, {}));
}

Balance balance(PointPasses& points, MPI_Comm comm, const Options& options, const Cuts& previous) {
    Participant self = mpi::enter(comm, CallName::balance);
    const double start = MPI_Wtime();
    CheckedPasses checked(points);
    Balance result = balance(checked, options, given(previous), true, self);
    print_line(result, options, start, self);
    // The last passes may have failed on a rank, and no later message would report that.
    agree(self);
    return result;
}

}  // namespace rrcb
