#include "measurement_mpi.hpp"

#include "failure_mpi.hpp"
#include "partitioner_mpi.hpp"

#include <rrcb/quality.hpp>

#include <zoltan.h>

#include <algorithm>
#include <memory>

namespace comparisons {

namespace {

/// A method under measurement; without a partitioner once it has failed.
struct Candidate {
    std::unique_ptr<Partitioner> partitioner;
    Measurement measurement;
};

Candidate make_candidate(const Workload& workload, const Method& method, Lists lists,
                         MPI_Comm comm) {
    Candidate candidate;
    candidate.measurement.method = method.label;
    try {
        candidate.partitioner = make_partitioner(method, workload, lists, comm);
    } catch (const Failure& failure) {
        candidate.measurement.error = failure.what();
    }
    return candidate;
}

void note_code(Candidate& candidate, int code, MPI_Comm comm) {
    const bool failed = code != ZOLTAN_OK && code != ZOLTAN_WARN;
    candidate.measurement.error = first_message(
        failed ? "Zoltan_LB_Partition returned " + std::to_string(code) : std::string(), comm);
    if (!candidate.measurement.error.empty()) candidate.partitioner.reset();
}

/// One call; milliseconds on the slowest rank. The lists are still there.
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
    for (const char* name : counted_functions) {
        const CallCount& count = mine[name];
        std::int64_t sums[] = {count.calls, count.bytes_in, count.bytes_out};
        MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_INT64_T, MPI_SUM, comm);
        if (sums[0] > 0) all[name] = {sums[0], sums[1], sums[2]};
    }
    return all;
}

void count_and_judge(Candidate& candidate, const Workload& workload, MPI_Comm comm) {
    start_counting_traffic();
    const int code = candidate.partitioner->partition();
    const Traffic traffic = stop_counting_traffic();
    Measurement& result = candidate.measurement;
    result.calls = over_all_ranks(counted_calls(), comm);
    result.traffic = over_all_ranks(traffic, comm);
    note_code(candidate, code, comm);
    if (!candidate.partitioner) return;

    int num_parts = 0;
    MPI_Comm_size(comm, &num_parts);
    result.parts = candidate.partitioner->parts();
    const std::vector<double> weights =
        rrcb::part_weights(workload.points(), result.parts, num_parts, comm);
    result.imbalance = rrcb::imbalance(weights);
    result.worst_unbalance_percent = rrcb::worst_load_unbalance_percent(weights);
    result.moved_fraction = rrcb::moved_fraction(workload.points(), result.parts, num_parts, comm);
}

}  // namespace

std::vector<Measurement> measure(const Workload& workload, std::span<const Method> methods,
                                 const MeasurementPlan& plan, Progress& progress, MPI_Comm comm) {
    std::vector<Candidate> candidates;
    for (const Method& method : methods) {
        candidates.push_back(make_candidate(workload, method, plan.lists, comm));
    }
    progress.start(workload.name + ": methods",
                   static_cast<int>(methods.size()) * (plan.repeats + 2));
    for (int call = 0; call < plan.repeats + 2; ++call) {
        for (Candidate& candidate : candidates) {
            progress.advance();
            if (!candidate.partitioner) continue;
            if (call > plan.repeats) {
                count_and_judge(candidate, workload, comm);
            } else {
                const double elapsed = timed_call(candidate, comm);
                if (call > 0) candidate.measurement.times_ms.push_back(elapsed);
            }
            if (candidate.partitioner) candidate.partitioner->free_lists();
        }
    }
    std::vector<Measurement> measurements;
    for (Candidate& candidate : candidates) {
        measurements.push_back(std::move(candidate.measurement));
    }
    return measurements;
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace comparisons
