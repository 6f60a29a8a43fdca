#include "agreement_mpi.hpp"
#include "mpi/communicator.hpp"
#include "mpi/duplicate.hpp"

#include <rrcb/error.hpp>
#include <rrcb/plan.hpp>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

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

void check_parts(std::span<const Part> parts, int num_parts) {
    const auto is_none = [&](Part part) { return part < 0 || part >= num_parts; };
    if (std::ranges::any_of(parts, is_none))
        throw Error(ErrorCode::invalid_argument,
                    "a part is outside 0 ... " + std::to_string(num_parts - 1));
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

std::size_t most_notices() {
    return mpi::longest_message / sizeof(Notice);
}

/// Messages of this rank, with room for all that comes and goes.
struct Exchange {
    std::vector<Notice> outbox;  ///< for one destination after the other
    std::vector<Notice> inbox;   ///< in the order of arrival
    struct Message {
        int source;
        std::size_t first;  ///< in the inbox
        std::size_t count;
    };
    std::vector<Message> arrived;
    std::vector<MPI_Request> requests;
};

/// Fills the outbox, and `counts` with the number of notices for each rank.
void sort_by_destination(const Plan& plan, std::span<std::int64_t> counts, Exchange& exchange) {
    exchange.outbox.resize(plan.export_indices.size());
    for (const int destination : plan.export_ranks) ++counts[static_cast<std::size_t>(destination)];
    std::vector<std::size_t> next(counts.size());
    std::exclusive_scan(counts.begin(), counts.end(), next.begin(), std::size_t{0});
    for (std::size_t k = 0; k < plan.export_indices.size(); ++k) {
        const auto destination = static_cast<std::size_t>(plan.export_ranks[k]);
        exchange.outbox[next[destination]++] = {plan.export_indices[k], plan.export_parts[k]};
    }
    const std::size_t most = counts.size() + exchange.outbox.size() / most_notices();
    exchange.requests.reserve(
        static_cast<std::size_t>(mpi::to_int(static_cast<std::int64_t>(most))));
}

/// How many notices come to this rank. Collective: one reduction.
std::size_t count_imports(std::span<const std::int64_t> counts, MPI_Comm comm) {
    std::int64_t num_imports = 0;
    mpi::check(MPI_Reduce_scatter_block(counts.data(), &num_imports, 1, MPI_INT64_T, MPI_SUM, comm),
               "MPI_Reduce_scatter_block");
    return static_cast<std::size_t>(num_imports);
}

void make_room(std::size_t num_imports, std::size_t num_ranks, Exchange& exchange, Plan& plan) {
    exchange.inbox.resize(num_imports);
    exchange.arrived.reserve(std::min(num_imports, num_ranks + num_imports / most_notices()));
    plan.import_ranks.reserve(num_imports);
    plan.import_indices.reserve(num_imports);
    plan.import_parts.reserve(num_imports);
}

void send_all(std::span<const std::int64_t> counts, Exchange& exchange, Member& me) {
    const Notice* next = exchange.outbox.data();
    for (std::size_t destination = 0; destination < counts.size(); ++destination) {
        auto left = static_cast<std::size_t>(counts[destination]);
        while (left > 0) {
            const std::size_t count = std::min(left, most_notices());
            MPI_Request& request = exchange.requests.emplace_back(MPI_REQUEST_NULL);
            me.always([&] {
                mpi::check(MPI_Isend(next, static_cast<int>(count * sizeof(Notice)), MPI_BYTE,
                                     static_cast<int>(destination), plan_tag, me.comm, &request),
                           "MPI_Isend");
            });
            next += count;
            left -= count;
        }
    }
}

void receive_all(Exchange& exchange, Member& me) {
    std::size_t first = 0;
    while (first < exchange.inbox.size()) {
        const std::size_t most = std::min(exchange.inbox.size() - first, most_notices());
        MPI_Status status{};
        int bytes = 0;
        me.always([&] {
            mpi::check(MPI_Recv(&exchange.inbox[first], static_cast<int>(most * sizeof(Notice)),
                                MPI_BYTE, MPI_ANY_SOURCE, plan_tag, me.comm, &status),
                       "MPI_Recv");
        });
        if (MPI_Get_count(&status, MPI_BYTE, &bytes) != MPI_SUCCESS || bytes <= 0) return;
        const std::size_t count = static_cast<std::size_t>(bytes) / sizeof(Notice);
        exchange.arrived.push_back({status.MPI_SOURCE, first, count});
        first += count;
    }
}

/// Lists what arrived by rank, whatever the order of arrival.
void list_imports(Exchange& exchange, Plan& plan) {
    std::ranges::sort(exchange.arrived, [](const auto& a, const auto& b) {
        return std::pair(a.source, a.first) < std::pair(b.source, b.first);
    });
    for (const Exchange::Message& message : exchange.arrived) {
        for (const Notice& notice :
             std::span(exchange.inbox).subspan(message.first, message.count)) {
            plan.import_ranks.push_back(message.source);
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
    mpi::Duplicate& kept = mpi::duplicate_with(user);
    const MPI_Comm comm = kept.comm;
    std::vector<std::int64_t>& counts = kept.per_rank;
    Member me{comm};
    Plan result;
    Exchange exchange;
    std::ranges::fill(counts, 0);
    me.locally([&] {
        check_parts(parts, num_parts);
        list_exports(parts, num_parts, comm, result);
        sort_by_destination(result, counts, exchange);
    });
    if (me.failure.failed) std::ranges::fill(counts, 0);
    const std::size_t num_imports = count_imports(counts, comm);
    me.locally([&] { make_room(num_imports, counts.size(), exchange, result); });
    agree(me);
    send_all(counts, exchange, me);
    receive_all(exchange, me);
    me.always([&] {
        mpi::check(MPI_Waitall(static_cast<int>(exchange.requests.size()), exchange.requests.data(),
                               MPI_STATUSES_IGNORE),
                   "MPI_Waitall");
    });
    // Of messages between two ranks nobody else hears any more.
    if (me.failure.failed) throw Error(me.failure.code, me.failure.text.data());
    list_imports(exchange, result);
    return result;
}

}  // namespace rrcb
