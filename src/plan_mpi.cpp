#include "mpi/communicator.hpp"

#include <rrcb/error.hpp>
#include <rrcb/plan.hpp>

#include <algorithm>
#include <numeric>
#include <string>

namespace rrcb {

namespace {

constexpr int plan_tag = 1;

/// What the importing rank is told of one point.
struct Notice {
    std::uint64_t index;
    std::int32_t part;
    std::int32_t unused = 0;
};

/// Among the ranks of the part: this one when it can stay, else spread by the sender's number.
int destination_of(Part part, int num_parts, int rank, int num_ranks) {
    const RankRange ranks = ranks_of_part(part, num_parts, num_ranks);
    if (rank >= ranks.first && rank < ranks.first + ranks.count) return rank;
    return ranks.first + rank % ranks.count;
}

/// First rank of a part with ranks to share out: those left over go to the parts before the last.
int first_rank_of(Part part, int num_parts, int num_ranks) {
    if (part == num_parts) return num_ranks;
    const int left_over = num_ranks % num_parts;
    return part * (num_ranks / num_parts) + std::max(0, part + left_over + 1 - num_parts);
}

void check_parts(std::span<const Part> parts, int num_parts, MPI_Comm comm) {
    const auto valid = [&](Part part) { return part >= 0 && part < num_parts; };
    const bool ok = std::all_of(parts.begin(), parts.end(), valid);
    const int rank = mpi::rank_of(comm);
    int failing_rank = ok ? mpi::size_of(comm) : rank;
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, &failing_rank, 1, MPI_INT, MPI_MIN, comm),
               "MPI_Allreduce");
    if (failing_rank < mpi::size_of(comm))
        throw Error(ErrorCode::invalid_argument, "rank " + std::to_string(failing_rank) +
                                                     ": a part is outside 0 ... " +
                                                     std::to_string(num_parts - 1));
}

void list_exports(std::span<const Part> parts, int num_parts, MPI_Comm comm, Plan& plan) {
    const int rank = mpi::rank_of(comm);
    const int num_ranks = mpi::size_of(comm);
    for (LocalIndex i = 0; i < parts.size(); ++i) {
        const int destination = destination_of(parts[i], num_parts, rank, num_ranks);
        if (destination == rank) continue;
        plan.export_indices.push_back(i);
        plan.export_ranks.push_back(destination);
        plan.export_parts.push_back(parts[i]);
    }
}

/// Notices for one destination after the other, and how many each rank is to get.
struct Outbox {
    std::vector<Notice> notices;
    std::vector<int> counts;
};

Outbox sort_by_destination(const Plan& plan, int num_ranks) {
    Outbox outbox{std::vector<Notice>(plan.export_indices.size()),
                  std::vector<int>(static_cast<std::size_t>(num_ranks))};
    for (const int destination : plan.export_ranks)
        ++outbox.counts[static_cast<std::size_t>(destination)];
    std::vector<std::size_t> next(outbox.counts.size());
    std::exclusive_scan(outbox.counts.begin(), outbox.counts.end(), next.begin(), std::size_t{0});
    for (std::size_t k = 0; k < plan.export_indices.size(); ++k) {
        const auto destination = static_cast<std::size_t>(plan.export_ranks[k]);
        outbox.notices[next[destination]++] = {plan.export_indices[k], plan.export_parts[k]};
    }
    return outbox;
}

/// Sends one message to each destination; returns the requests. `outbox` must outlive them.
std::vector<MPI_Request> send(const Outbox& outbox, MPI_Comm comm) {
    std::vector<MPI_Request> requests;
    std::size_t offset = 0;
    for (std::size_t destination = 0; destination < outbox.counts.size(); ++destination) {
        const auto count = static_cast<std::size_t>(outbox.counts[destination]);
        if (count == 0) continue;
        mpi::check(
            MPI_Isend(outbox.notices.data() + offset,
                      mpi::to_int(static_cast<std::int64_t>(count * sizeof(Notice))), MPI_BYTE,
                      static_cast<int>(destination), plan_tag, comm, &requests.emplace_back()),
            "MPI_Isend");
        offset += count;
    }
    return requests;
}

int count_senders(const Outbox& outbox, MPI_Comm comm) {
    std::vector<int> sends(outbox.counts.size());
    std::transform(outbox.counts.begin(), outbox.counts.end(), sends.begin(),
                   [](int count) { return count > 0 ? 1 : 0; });
    int senders = 0;
    mpi::check(MPI_Reduce_scatter_block(sends.data(), &senders, 1, MPI_INT, MPI_SUM, comm),
               "MPI_Reduce_scatter_block");
    return senders;
}

/// Receives `senders` messages and lists them by rank, whatever the order of arrival.
void list_imports(int senders, MPI_Comm comm, Plan& plan) {
    std::vector<std::pair<int, std::vector<Notice>>> inbox;
    for (int k = 0; k < senders; ++k) {
        MPI_Status status;
        mpi::check(MPI_Probe(MPI_ANY_SOURCE, plan_tag, comm, &status), "MPI_Probe");
        int bytes = 0;
        mpi::check(MPI_Get_count(&status, MPI_BYTE, &bytes), "MPI_Get_count");
        auto& [source, notices] = inbox.emplace_back(status.MPI_SOURCE, std::vector<Notice>());
        notices.resize(static_cast<std::size_t>(bytes) / sizeof(Notice));
        mpi::check(
            MPI_Recv(notices.data(), bytes, MPI_BYTE, source, plan_tag, comm, MPI_STATUS_IGNORE),
            "MPI_Recv");
    }
    std::sort(inbox.begin(), inbox.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [source, notices] : inbox) {
        for (const Notice& notice : notices) {
            plan.import_ranks.push_back(source);
            plan.import_indices.push_back(notice.index);
            plan.import_parts.push_back(notice.part);
        }
    }
}

}  // namespace

RankRange ranks_of_part(Part part, int num_parts, int num_ranks) {
    if (num_parts < num_ranks) {
        const int first = first_rank_of(part, num_parts, num_ranks);
        return {first, first_rank_of(part + 1, num_parts, num_ranks) - first};
    }
    const int share = num_parts / num_ranks;
    const int first_larger = num_ranks - num_parts % num_ranks;
    const int boundary = first_larger * share;
    const int rank =
        part < boundary ? part / share : first_larger + (part - boundary) / (share + 1);
    return {rank, 1};
}

Plan plan(std::span<const Part> parts, int num_parts, MPI_Comm user) {
    const MPI_Comm comm = mpi::duplicate_of(user);
    check_parts(parts, num_parts, comm);
    Plan result;
    list_exports(parts, num_parts, comm, result);
    const Outbox outbox = sort_by_destination(result, mpi::size_of(comm));
    const int senders = count_senders(outbox, comm);
    std::vector<MPI_Request> requests = send(outbox, comm);
    list_imports(senders, comm, result);
    mpi::check(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE),
               "MPI_Waitall");
    return result;
}

}  // namespace rrcb
