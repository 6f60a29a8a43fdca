#include "phase_log_mpi.hpp"

#include "failure_mpi.hpp"
#include "statistics.hpp"

#include <algorithm>
#include <bit>

namespace comparisons {

std::vector<double> largest_of_ranks(std::vector<double> of_phases, MPI_Comm comm) {
    MPI_Allreduce(MPI_IN_PLACE, of_phases.data(), static_cast<int>(of_phases.size()), MPI_DOUBLE,
                  MPI_MAX, comm);
    return of_phases;
}

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
    cost.work_s = cost.root_s = sum(work_s_);
    MPI_Bcast(&cost.root_s, 1, MPI_DOUBLE, 0, comm);
    MPI_Allreduce(MPI_IN_PLACE, &cost.work_s, 1, MPI_DOUBLE, MPI_SUM, comm);
    cost.path_s = sum(largest_of_ranks(work_s_, comm));
    cost.network_s = sum(largest_of_ranks(network_s, comm));
    return cost;
}

}  // namespace comparisons
