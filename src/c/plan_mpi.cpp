#include "c/columns.hpp"
#include "c/handle_mpi.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/remap_mpi.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <string>

namespace rrcb::c {

namespace {

/// Returns the ranks of all parts: the given ones or, by default, those of ranks_of_part().
std::vector<RankRange> ranks_of_parts(const rrcb_rank_range* given, int num_parts, int num_ranks) {
    std::vector<RankRange> ranks;
    for (Part part = 0; part < num_parts; ++part)
        ranks.push_back(given == nullptr ? ranks_of_part(part, num_parts, num_ranks)
                                         : RankRange{given[part].first_rank, given[part].count});
    return ranks;
}

/// Throws Error if there are fewer points than were balanced or assigned.
void require_all(const rrcb_balancer& own, std::size_t count) {
    const std::size_t least = own.least_count;
    if (least != rrcb_balancer::no_count && count < least)
        reject("count is " + std::to_string(count) + ", but " + std::to_string(least) +
               " points were balanced or assigned; give the parts of all of them");
}

}  // namespace

}  // namespace rrcb::c

using rrcb::CallName;
using rrcb::Participant;
using rrcb::c::guarded;
using rrcb::c::guarded_together;
using rrcb::c::require_array;

int rrcb_ranks_of_part(int32_t part, int num_parts, int num_ranks, rrcb_rank_range* ranks) {
    return guarded([&] {
        rrcb::c::require(ranks, "ranks");
        const rrcb::RankRange from = rrcb::ranks_of_part(part, num_parts, num_ranks);
        *ranks = {from.first_rank, from.count};
    });
}

int rrcb_plan(rrcb_balancer* balancer, size_t count, const int32_t* parts) {
    return guarded_together(CallName::plan, balancer, [&](auto& own, Participant& self) {
        self.attempt([&] {
            rrcb::c::require_cuts(own);
            require_array(count, parts, "parts");
            rrcb::c::require_all(own, count);
        });
        own.plan = rrcb::plan(rrcb::c::view(parts, count), own.cuts.num_parts, self);
    });
}

int rrcb_transfer(rrcb_balancer* balancer, size_t num_columns, const rrcb_column* columns,
                  const rrcb_transfer_options* options) {
    return guarded_together(CallName::transfer, balancer, [&](auto& own, Participant& self) {
        self.attempt([&] { rrcb::c::require_plan(own); });
        const rrcb::Plan none;
        const rrcb::Plan& plan = own.plan ? *own.plan : none;
        const rrcb::c::ColumnCall call{num_columns, columns, options};
        call.move_by(plan, plan.num_points, rrcb::c::num_points_after(plan), self);
        own.lower_count(rrcb::c::num_points_after(plan));
    });
}

int rrcb_remap(rrcb_balancer* balancer, size_t count, const int32_t* parts, const int32_t* previous,
               const rrcb_rank_range* ranks_of_parts, size_t num_parts, int32_t* numbers,
               rrcb_remap_report* report) {
    return guarded_together(CallName::remap, balancer, [&](auto& own, Participant& self) {
        std::vector<rrcb::RankRange> ranks;
        self.attempt([&] {
            rrcb::c::require_parts(own, num_parts);
            require_array(count, parts, "parts");
            rrcb::c::require(numbers, "numbers");
            if (report != nullptr) rrcb::c::require_sized(report, "report");
            ranks = rrcb::c::ranks_of_parts(ranks_of_parts, own.cuts.num_parts,
                                            rrcb::mpi::size_of(self.comm));
        });
        rrcb::PreviousParts earlier;
        if (previous != nullptr) earlier = rrcb::c::view(previous, count);
        const rrcb::Remap made =
            rrcb::remap(rrcb::c::view(parts, count), earlier, ranks, own.cuts.shape, self);
        std::ranges::copy(made.numbers, numbers);
        if (report != nullptr)
            rrcb::c::copy_out(
                {0, made.identity ? 1 : 0, made.num_points, made.kept_before, made.kept_after},
                report);
    });
}
