#include "follower_mpi.hpp"

#include "failure_mpi.hpp"
#include "text.hpp"
#include "traffic.hpp"

#include <algorithm>
#include <utility>

namespace comparisons {

namespace {

/// Returns the part of every particle on all ranks. Collective.
std::vector<rrcb::Part> gathered(const std::vector<rrcb::Part>& parts,
                                 const std::vector<std::size_t>& here, std::size_t count,
                                 MPI_Comm comm) {
    std::vector<rrcb::Part> all(count);
    for (std::size_t k = 0; k < here.size(); ++k) all[here[k]] = parts[k];
    MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(count), MPI_INT, MPI_SUM, comm);
    return all;
}

}  // namespace

std::vector<Policy> policies(const std::vector<std::string>& names) {
    const std::vector<Policy> all{{"library", true, false, false},
                                  {"kept axes", true, true, false},
                                  {"fresh", false, false, false},
                                  {"fresh + remap", false, false, true}};
    if (names.empty()) return all;
    std::vector<Policy> chosen;
    for (const std::string& name : names) {
        const auto found = std::ranges::find(all, name, &Policy::name);
        if (found == all.end())
            throw Failure("policy '" + name + "' is none of " + joined(all, &Policy::name));
        chosen.push_back(*found);
    }
    return chosen;
}

Follower::Follower(const Policy& policy, int num_parts, MPI_Comm comm)
    : policy_(policy), comm_(comm) {
    options_.num_parts = num_parts;
    for (rrcb::Part part = 0; part < num_parts; ++part)
        ranks_of_parts_.push_back(rrcb::ranks_of_part(part, num_parts, size_of(comm)));
}

std::vector<std::size_t> Follower::particles_here(std::size_t count) const {
    const int rank_here = rank_of(comm_);
    const auto num_ranks = static_cast<std::size_t>(size_of(comm_));
    const bool are_dealt = parts_.empty() || !policy_.has_previous;
    std::vector<std::size_t> here;
    for (std::size_t i = 0; i < count; ++i) {
        const int rank = are_dealt
                             ? static_cast<int>(i % num_ranks)
                             : ranks_of_parts_[static_cast<std::size_t>(parts_[i])].first_rank;
        if (rank == rank_here) here.push_back(i);
    }
    return here;
}

void Follower::renumber(std::vector<rrcb::Part>& parts,
                        const std::vector<std::size_t>& here) const {
    std::vector<rrcb::Part> before;
    for (const std::size_t i : here) before.push_back(parts_[i]);
    const rrcb::Remap remap = rrcb::remap(parts, before, ranks_of_parts_, comm_, cuts_.shape);
    for (rrcb::Part& part : parts) part = remap.numbers[static_cast<std::size_t>(part)];
}

CallCounts Follower::go_on(const Workload& all) {
    const std::size_t count = all.points().count;
    const std::vector<std::size_t> here = particles_here(count);
    Workload mine{all.name, "", all.dimension, {}, false, {}};
    const auto width = static_cast<std::ptrdiff_t>(all.dimension);
    for (const std::size_t i : here) {
        const auto first = all.coordinates.begin() + static_cast<std::ptrdiff_t>(i) * width;
        mine.coordinates.insert(mine.coordinates.end(), first, first + width);
    }
    start_counting_traffic();
    rrcb::Balance balance =
        rrcb::balance(mine.points(), comm_, options_, policy_.has_previous ? cuts_ : rrcb::Cuts{});
    cuts_ = std::move(balance.cuts);
    if (policy_.renumbers && !parts_.empty()) renumber(balance.parts, here);
    CallCounts counts{.messages = stop_counting_traffic().messages};
    if (policy_.keeps_axes && parts_.empty()) {
        std::vector<int> axes;
        for (const rrcb::Cut& cut : cuts_.tree) axes.push_back(cut.axis);
        options_.expert.axes.order = rrcb::AxisOrder::given(axes);
    }
    const std::vector<rrcb::Part> before =
        std::exchange(parts_, gathered(balance.parts, here, count, comm_));
    for (std::size_t i = 0; i < before.size(); ++i) counts.moved += before[i] != parts_[i];
    MPI_Allreduce(MPI_IN_PLACE, &counts.messages, 1, MPI_INT64_T, MPI_SUM, comm_);
    return counts;
}

}  // namespace comparisons
