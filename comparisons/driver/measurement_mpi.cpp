#include "measurement_mpi.hpp"

#include "counter_random.hpp"
#include "failure_mpi.hpp"
#include "partitioner_mpi.hpp"
#include "progress.hpp"
#include "statistics.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/paper.hpp>
#include <rrcb/quality.hpp>

#include <zoltan.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace comparisons {

namespace {

/// The quality of the parts of one call.
struct Judgement {
    double imbalance = 1;
    double worst_unbalance_percent = 0;
    double moved_fraction = 0;
};

/// A method that is measured. Its partitioner is null once it has failed.
struct Candidate {
    Candidate(const Method& measured, const Workload& workload, Lists lists, MPI_Comm comm)
        : method(measured) {
        result.method = method.label;
        try {
            partitioner = make_partitioner(method, workload, lists, comm);
        } catch (const Failure& failure) {
            result.error = failure.what();
        }
    }

    int num_judged() const { return varies_with_seed(method) ? num_judged_seeds : 1; }

    /// Sets the seed of the next call. The calls use the seeds in turn.
    void choose_seed(int turn) const {
        if (varies_with_seed(method))
            partitioner->use_seed(method.seed() + static_cast<unsigned>(turn % num_judged_seeds));
    }

    Method method;
    std::unique_ptr<Partitioner> partitioner;
    Measurement result;
    std::vector<Judgement> judgements;  ///< one for each seed
};

void note_code(Candidate& candidate, int code, MPI_Comm comm) {
    const bool failed = code != ZOLTAN_OK && code != ZOLTAN_WARN;
    candidate.result.error = first_message(
        failed ? candidate.partitioner->function() + " failed with code " + std::to_string(code)
               : std::string(),
        comm);
    if (!candidate.result.error.empty()) candidate.partitioner.reset();
}

/// Makes one call and returns the milliseconds on the slowest rank. The lists of the call are kept.
double timed_call(Candidate& candidate, MPI_Comm comm) {
    MPI_Barrier(comm);
    const double start = MPI_Wtime();
    const int code = candidate.partitioner->partition();
    double elapsed = (MPI_Wtime() - start) * 1e3;
    MPI_Allreduce(MPI_IN_PLACE, &elapsed, 1, MPI_DOUBLE, MPI_MAX, comm);
    note_code(candidate, code, comm);
    return elapsed;
}

Traffic over_all_ranks(Traffic traffic, MPI_Comm comm) {
    std::int64_t sums[] = {traffic.messages, traffic.bytes, traffic.root_bytes_in};
    std::int64_t most[] = {traffic.collectives, traffic.communicators};
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_INT64_T, MPI_SUM, comm);
    MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_INT64_T, MPI_MAX, comm);
    return {sums[0], sums[1], sums[2], most[0], most[1]};
}

std::map<std::string, CallCount> over_all_ranks(std::map<std::string, CallCount> mine,
                                                MPI_Comm comm) {
    std::map<std::string, CallCount> all;
    for (const char* name : counted_functions()) {
        const CallCount& count = mine[name];
        std::int64_t sums[] = {count.calls, count.bytes_in, count.bytes_out};
        MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_INT64_T, MPI_SUM, comm);
        if (sums[0] > 0) all[name] = {sums[0], sums[1], sums[2]};
    }
    return all;
}

Judgement judge(const Workload& workload, const std::vector<rrcb::Part>& parts, MPI_Comm comm) {
    const int num_parts = size_of(comm);
    const std::vector<double> weights =
        rrcb::part_weights(workload.points(), parts, num_parts, comm);
    return {rrcb::imbalance(weights), largest_by_size(rrcb::load_unbalance_percent(weights)),
            rrcb::moved_fraction(workload.points(), parts, num_parts, comm)};
}

/// Makes one call that is not timed. The traffic of the first seed's call is counted.
void count_and_judge(Candidate& candidate, const Workload& workload, MPI_Comm comm) {
    start_counting_traffic();
    const int code = candidate.partitioner->partition();
    const Traffic traffic = stop_counting_traffic();
    const bool is_first = candidate.judgements.empty();
    Measurement& result = candidate.result;
    if (is_first) {
        result.calls = over_all_ranks(counted_calls(), comm);
        result.traffic = over_all_ranks(traffic, comm);
    }
    note_code(candidate, code, comm);
    if (!candidate.partitioner) return;
    std::vector<rrcb::Part> parts = candidate.partitioner->parts();
    candidate.judgements.push_back(judge(workload, parts, comm));
    if (is_first) result.parts = std::move(parts);
}

/// Computes the results from the calls of all seeds.
void conclude(Candidate& candidate) {
    Measurement& result = candidate.result;
    std::vector<Judgement>& judgements = candidate.judgements;
    if (!result.error.empty() || judgements.empty()) return;
    std::vector<double> moved;
    for (const Judgement& judgement : judgements) {
        result.imbalances.push_back(judgement.imbalance);
        moved.push_back(judgement.moved_fraction);
    }
    result.moved_fraction = median(std::move(moved));
    std::ranges::sort(judgements, {},
                      [](const Judgement& j) { return std::abs(j.worst_unbalance_percent); });
    result.worst_unbalance_percent =
        judgements[(judgements.size() - 1) / 2].worst_unbalance_percent;
}

/// Returns a seed for the order of the turns. It differs between workloads. With the same order for
/// all of them, the advantage that an order gives to a method would be counted once per workload.
std::uint64_t order_seed(const Workload& workload, std::uint64_t seed, MPI_Comm comm) {
    const std::string numbers =
        ' ' + std::to_string(workload.dimension) + ' ' + std::to_string(size_of(comm));
    return seed_for(workload.name + numbers, seed);
}

/// Calls each method once without timing it, then repeatedly, in a new order in each turn.
void time_in_turns(std::span<Candidate> candidates, const MeasurementPlan& plan,
                   const Workload& workload, MPI_Comm comm) {
    const std::uint64_t seed = order_seed(workload, plan.seed, comm);
    Progress progress(plan.progress && rank_of(comm) == 0, workload.name + ", turns of calls",
                      plan.repeats + 1);
    for (int call = 0; call < plan.repeats + 1; ++call) {
        // The first two timed turns have opposite orders.
        const auto turn = static_cast<std::uint64_t>(call + 1);
        for (const std::size_t next : drawn_order(candidates.size(), seed, turn)) {
            Candidate& candidate = candidates[next];
            if (!candidate.partitioner) continue;
            candidate.choose_seed(std::max(0, call - 1));
            const double elapsed = timed_call(candidate, comm);
            if (call > 0) candidate.result.times_ms.push_back(elapsed);
            if (candidate.partitioner) candidate.partitioner->free_lists();
        }
        progress.advance(1);
    }
}

void judge_all(std::span<Candidate> candidates, const Workload& workload, MPI_Comm comm) {
    for (Candidate& candidate : candidates) {
        for (int call = 0; call < candidate.num_judged(); ++call) {
            if (!candidate.partitioner) continue;
            candidate.choose_seed(call);
            count_and_judge(candidate, workload, comm);
            if (candidate.partitioner) candidate.partitioner->free_lists();
        }
        if (candidate.partitioner && candidate.method.options)
            candidate.result.rounds =
                balance(*candidate.method.options, workload.points(), comm).report.details.rounds;
        conclude(candidate);
    }
}

}  // namespace

std::vector<Measurement> measure(const Workload& workload, std::span<const Method> methods,
                                 const MeasurementPlan& plan, MPI_Comm comm) {
    std::vector<Candidate> candidates;
    for (const Method& method : methods)
        candidates.emplace_back(method, workload, plan.lists, comm);
    time_in_turns(candidates, plan, workload, comm);
    judge_all(candidates, workload, comm);
    const GhostCounter ghosts(workload, plan.ghosts, comm);
    std::vector<Measurement> measurements;
    for (Candidate& candidate : candidates) {
        Measurement& result = measurements.emplace_back(std::move(candidate.result));
        if (result.error.empty()) result.ghosts = ghosts.count(result.parts, size_of(comm));
    }
    return measurements;
}

double largest_by_size(std::span<const double> values) {
    if (values.empty()) return 0;
    return std::ranges::max(values, {}, [](double v) { return std::pair(std::abs(v), -v); });
}

}  // namespace comparisons
