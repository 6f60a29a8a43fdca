#pragma once

#include "c/balancer.hpp"
#include "lists/delivery_mpi.hpp"

#include <rrcb/ghosts.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace rrcb::c {

/// Reads the periodic box, and the ranks of the parts of the balancer's cuts. `options` borrows
/// `ranks`.
template <class Given, class Options>
void read_domain(const Given& from, Options& options, std::vector<RankRange>& ranks,
                 const rrcb_balancer& own) {
    if (from.lower != nullptr || from.upper != nullptr) {
        require(from.lower, "lower");
        require(from.upper, "upper");
        options.periodic.emplace();
        std::copy_n(from.lower, max_dimension, options.periodic->lower.begin());
        std::copy_n(from.upper, max_dimension, options.periodic->upper.begin());
    }
    require_array(from.num_parts, from.ranks_of_parts, "ranks_of_parts");
    if (from.ranks_of_parts == nullptr) return;
    require_parts(own, from.num_parts);
    for (const rrcb_rank_range& given : view(from.ranks_of_parts, from.num_parts))
        ranks.push_back({given.first_rank, given.count});
    options.ranks_of_parts = ranks;
}

inline const rrcb_rank_count* counts_at(const std::vector<RankCount>& counts) {
    // Both structs consist of a rank and a number.
    static_assert(sizeof(rrcb_rank_count) == sizeof(RankCount) &&
                  offsetof(rrcb_rank_count, count) == offsetof(RankCount, count));
    return reinterpret_cast<const rrcb_rank_count*>(counts.data());
}

/// Returns a view of the lists of a ghost plan.
inline rrcb_ghost_plan view_of(const GhostPlan& from) {
    return {0,
            from.num_points,
            total(from.receive),
            from.send.size(),
            counts_at(from.send),
            from.send_indices.size(),
            from.send_indices.data(),
            from.receive.size(),
            counts_at(from.receive),
            from.shifts.empty() ? nullptr : from.shifts.front().data()};
}

}  // namespace rrcb::c
