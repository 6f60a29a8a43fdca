#include "phase_log_mpi.hpp"

#include "failure_mpi.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace comparisons {

namespace {

/// Returns the sum over the phases of the largest value on any rank.
double sum_of_largest(std::vector<double> values, MPI_Comm comm) {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX,
                  comm);
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

double network_seconds(const Traffic& traffic, int num_ranks, const Network& network, Waits waits) {
    const int all_rounds = std::bit_width(static_cast<unsigned>(num_ranks - 1));
    const int rounds = waits == Waits::in_the_next ? std::min(all_rounds, 1) : all_rounds;
    const auto to_one = static_cast<double>(traffic.messages - traffic.collectives);
    const auto among_all = static_cast<double>(traffic.collectives + traffic.communicators);
    const double latencies = to_one + among_all * rounds;
    return latencies * network.latency_s +
           static_cast<double>(traffic.bytes) / network.bytes_per_second;
}

PhaseLog::Recording::Recording(PhaseLog& log) : log_(log) {
    start_counting_traffic();
    start_ = processor_seconds();
}

PhaseLog::Recording::~Recording() {
    const double elapsed = processor_seconds() - start_;
    const Traffic traffic = stop_counting_traffic();
    log_.work_s_.push_back(std::max(0.0, elapsed - traffic.seconds_in_mpi));
    log_.traffic_.push_back(traffic);
}

double PhaseLog::last_s(int num_ranks) const {
    return work_s_.back() + network_seconds(traffic_.back(), num_ranks, Network{}, waits_);
}

PathCost PhaseLog::cost(MPI_Comm comm) const {
    const int num_ranks = size_of(comm);
    std::vector<double> network_s;
    PathCost cost;
    for (const Traffic& traffic : traffic_) {
        network_s.push_back(network_seconds(traffic, num_ranks, Network{}, waits_));
        cost.messages += traffic.messages;
        cost.bytes += traffic.bytes;
    }
    for (std::int64_t* count : {&cost.messages, &cost.bytes})
        MPI_Allreduce(MPI_IN_PLACE, count, 1, MPI_INT64_T, MPI_SUM, comm);
    cost.work_s = std::accumulate(work_s_.begin(), work_s_.end(), 0.0);
    cost.root_s = cost.work_s;
    MPI_Bcast(&cost.root_s, 1, MPI_DOUBLE, 0, comm);
    MPI_Allreduce(MPI_IN_PLACE, &cost.work_s, 1, MPI_DOUBLE, MPI_SUM, comm);
    cost.path_s = sum_of_largest(work_s_, comm);
    cost.network_s = sum_of_largest(std::move(network_s), comm);
    return cost;
}

}  // namespace comparisons
