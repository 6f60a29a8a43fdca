#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/stamp_access.hpp"
#include "cuts/owned_cuts.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/notices_mpi.hpp"
#include "lists/transfer_log.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <rrcb/balance.hpp>

#include <algorithm>
#include <string>

namespace rrcb {

namespace {

/// Notice of one point, for the rank that imports it.
struct Notice {
    std::uint64_t index;
    std::int32_t part;
    std::int32_t unused = 0;
};

/// Returns the rank to which a point of the part goes. If this rank holds the part, the point
/// remains; otherwise this rank's number chooses among the ranks of the part, so that points are
/// spread over them.
int destination_of(Part part, int num_parts, int rank, int num_ranks) {
    const RankRange ranks = ranks_of_part(part, num_parts, num_ranks);
    if (ranks.contains(rank)) return rank;
    return ranks.first_rank + rank % ranks.count;
}

/// Returns the first rank of a part if there are more ranks than parts. Left-over ranks go to the
/// parts just before the last one, one to each.
int first_rank_of(Part part, int num_parts, int num_ranks) {
    if (part == num_parts) return num_ranks;
    const int left_over = num_ranks % num_parts;
    return part * (num_ranks / num_parts) + std::max(0, part + left_over + 1 - num_parts);
}

/// Lists the points to send. Throws Error unless each part is below `num_parts`.
void list_exports(std::span<const Part> parts, int num_parts, MPI_Comm comm, Plan& plan) {
    require_parts(num_parts);
    const int rank = mpi::rank_of(comm);
    const int num_ranks = mpi::size_of(comm);
    // Most points remain on their rank, so this case is tested first.
    const auto [first, end] = parts_on(rank, num_parts, num_ranks);
    const auto num_here = static_cast<std::uint32_t>(end - first);
    // Consecutive points mostly have the same part, which saves the divisions of destination_of().
    Part part = -1;
    int destination = rank;
    for (LocalIndex i = 0; i < parts.size(); ++i) {
        if (static_cast<std::uint32_t>(parts[i]) - static_cast<std::uint32_t>(first) < num_here)
            [[likely]]
            continue;
        if (parts[i] != part) {
            part = parts[i];
            if (part < 0 || part >= num_parts) check_parts(parts, num_parts);
            destination = destination_of(part, num_parts, rank, num_ranks);
        }
        plan.export_indices.push_back(i);
        plan.export_ranks.push_back(destination);
        plan.export_parts.push_back(parts[i]);
    }
}

}  // namespace

RankRange ranks_of_part(Part part, int num_parts, int num_ranks) {
    if (num_ranks < 1 || part < 0 || part >= num_parts) [[unlikely]]
        reject("part " + std::to_string(part) + " of " + std::to_string(num_parts) + " on " +
               std::to_string(num_ranks) + " ranks; parts and ranks count from 0");
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

Plan plan(std::span<const Part> parts, int num_parts, Participant& self) {
    Plan result;
    result.num_points = parts.size();
    self.attempt([&] { list_exports(parts, num_parts, self.comm, result); });
    exchange_records<Notice>(
        result.export_ranks,
        [&](std::size_t k) {
            return Notice{result.export_indices[k], result.export_parts[k]};
        },
        [&](std::size_t num_imports) {
            result.import_ranks.reserve(num_imports);
            result.import_indices.reserve(num_imports);
            result.import_parts.reserve(num_imports);
        },
        [&](int source, const Notice& notice) {
            result.import_ranks.push_back(source);
            result.import_indices.push_back(notice.index);
            result.import_parts.push_back(notice.part);
        },
        {{"num_parts", static_cast<std::uint64_t>(num_parts)}}, self);
    detail::StampAccess::ranks(result.stamp) = self.group();
    detail::StampAccess::points(result.stamp) = next_stamp();
    return result;
}

Plan plan(std::span<const Part> parts, int num_parts, MPI_Comm user) {
    Participant self = mpi::enter(user, CallName::plan);
    return plan(parts, num_parts, self);
}

Plan plan(const Balance& balance, MPI_Comm user) {
    Participant self = mpi::enter(user, CallName::plan);
    self.attempt([&] {
        mpi::require_group(detail::StampAccess::ranks(balance.cuts.stamp), "the balance", self);
    });
    return plan(balance.parts, balance.cuts.num_parts, self);
}

}  // namespace rrcb
