#include "c/columns.hpp"
#include "c/domain.hpp"
#include "c/for_experimental.h"
#include "c/handle_mpi.hpp"
#include "lists/delivery_mpi.hpp"
#include "lists/duplicated_mpi.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <type_traits>

struct rrcb_ghosts {
    static constexpr const char* name = "ghosts";
    MPI_Comm comm = MPI_COMM_NULL;
    rrcb::GhostPlan plan{};
    rrcb::experimental::Verification seen{};
};

namespace rrcb::c {

namespace {

/// The Fortran module passes this value as `needs` if the numbers of radii and points differ. It
/// passes the number of radii as `num_parts`.
constexpr int wrong_radii = -1;

void check_radii(const rrcb_ghost_options& from, LocalIndex num_points) {
    if (from.needs == wrong_radii)
        reject("cutoffs has " + std::to_string(from.num_parts) + " entries for " +
               std::to_string(num_points) + " points; give one for each, or one cutoff for all");
    if (from.cutoff == 0 && from.cutoffs == nullptr && num_points > 0)
        reject("cutoff is 0, and cutoffs is null; give one of them");
    if (from.cutoff != 0 && from.cutoffs != nullptr)
        reject("cutoff and cutoffs are both given; give one of them");
}

/// Options of a call, and the memory that they borrow.
struct KeptOptions {
    GhostOptions options{};
    std::vector<RankRange> ranks{};

    void read(const rrcb_ghost_options* from, LocalIndex num_points, const rrcb_balancer& own) {
        const rrcb_ghost_options given = copy_in(from, "options");
        check_radii(given, num_points);
        options.cutoff = given.cutoff;
        options.needs = static_cast<Needs>(given.needs);
        if (given.cutoffs != nullptr) options.cutoff = view(given.cutoffs, num_points);
        read_domain(given, options, ranks, own);
    }
};

void make_ghosts(const rrcb_balancer& own, const rrcb_points* given,
                 const rrcb_ghost_options* given_options, rrcb_ghosts** ghosts, Participant& self) {
    auto made = make_handle(self, ghosts);
    Points points;
    KeptOptions kept;
    self.attempt([&] {
        require_cuts(own);
        points = points_of(given);
        kept.read(given_options, points.count, own);
    });
    made->comm = own.comm;
    made->plan = rrcb::ghost_plan(own.cuts, points, kept.options, self);
    *ghosts = made.release();
}

experimental::VerifyOptions options_of(const rrcb_verify_options* from, LocalIndex num_points) {
    experimental::VerifyOptions options;
    if (from == nullptr) return options;
    if (from->sample == 0 && from->num_ids == 0 && num_points > 0)
        reject("sample is 0, and there are no ids; give one of them, or no options");
    options.sample = from->sample;
    if (from->cutoff != 0) options.cutoff = from->cutoff;
    if (from->cutoffs != nullptr) options.cutoff = view(from->cutoffs, num_points);
    require_array(from->num_ids, from->ids, "ids");
    require_array(from->num_ids_before, from->ids_before, "ids_before");
    if (from->num_ids > 0) options.ids = view(from->ids, from->num_ids);
    if (from->num_ids_before > 0) options.ids_before = view(from->ids_before, from->num_ids_before);
    return options;
}

const rrcb_fault* faults_at(const std::vector<experimental::Fault>& faults) {
    // Both structs consist of an id, a rank and an id.
    static_assert(sizeof(rrcb_fault) == sizeof(experimental::Fault) &&
                  offsetof(rrcb_fault, needed_by) == offsetof(experimental::Fault, needed_by));
    return reinterpret_cast<const rrcb_fault*>(faults.data());
}

void verify(rrcb_ghosts& own, const rrcb_points* given, const rrcb_verify_options* given_options,
            rrcb_verification* seen, Participant& self) {
    Points points;
    experimental::VerifyOptions options;
    self.attempt([&] {
        require(seen, "seen");
        points = points_of(given);
        options = options_of(given_options, points.count);
    });
    own.seen = experimental::verify(own.plan, points, options, self);
    const auto& [num_pairs, num_faults, missing, duplicates, not_mine] = own.seen;
    *seen = {num_pairs,          num_faults,         missing.size(),
             faults_at(missing), duplicates.size(),  faults_at(duplicates),
             not_mine.size(),    faults_at(not_mine)};
}

void accumulate(const rrcb_ghosts& own, std::span<const rrcb_column> columns,
                const TransferOptions& options, Participant& self) {
    std::vector<detail::ByteColumn> of_ghosts;
    std::vector<detail::ByteColumn> of_points;
    std::vector<ByteResult> arrived;
    self.attempt([&] {
        of_ghosts = columns_of(columns, total(own.plan.receive), own.plan.num_points);
        arrived.reserve(columns.size());
        for (std::size_t k = 0; k < columns.size(); ++k) {
            if (columns[k].type == RRCB_BYTE)
                reject("columns of RRCB_BYTE cannot be added; give a type of numbers");
            of_points.push_back(of_ghosts[k]);
            of_points[k].from = static_cast<const std::byte*>(columns[k].to);
            of_points[k].num_values = own.plan.num_points * columns[k].components;
            of_ghosts[k] =
                arrived.emplace_back(ByteResult{of_ghosts[k].value_bytes}).result_of(of_ghosts[k]);
        }
    });
    move_back(own.plan, of_ghosts, of_points, options, self);
    for (std::size_t k = 0; k < columns.size(); ++k)
        visit_type(columns[k].type, [&]<class T>(T) {
            if constexpr (!std::is_same_v<T, std::byte>)
                detail::add_each(own.plan.send_indices, columns[k].components,
                                 reinterpret_cast<const T*>(arrived[k].bytes.data()),
                                 static_cast<T*>(columns[k].to));
        });
}

}  // namespace

}  // namespace rrcb::c

using rrcb::CallName;
using rrcb::Participant;
using rrcb::c::guarded;
using rrcb::c::guarded_together;

int rrcb_ghosts_create(const rrcb_balancer* balancer, const rrcb_points* points,
                       const rrcb_ghost_options* options, rrcb_ghosts** ghosts) {
    return guarded_together(CallName::ghost_plan, balancer,
                            [&](const auto& own, Participant& self) {
                                rrcb::c::make_ghosts(own, points, options, ghosts, self);
                            });
}

void rrcb_ghosts_destroy(rrcb_ghosts** ghosts) {
    rrcb::c::destroy(ghosts);
}

int rrcb_ghosts_get_plan(const rrcb_ghosts* ghosts, rrcb_ghost_plan* plan) {
    return guarded(ghosts, [&](const auto& own) {
        rrcb::c::require_sized(plan, "plan");
        rrcb::c::copy_out(rrcb::c::view_of(own.plan), plan);
    });
}

int rrcb_ghosts_fetch(const rrcb_ghosts* ghosts, size_t num_columns, const rrcb_column* columns,
                      const rrcb_transfer_options* options) {
    return guarded_together(CallName::fetch, ghosts, [&](const auto& own, Participant& self) {
        const rrcb::c::ColumnCall call{num_columns, columns, options};
        call.move_by(own.plan, own.plan.num_points, rrcb::total(own.plan.receive), self);
    });
}

int rrcb_ghosts_reply(const rrcb_ghosts* ghosts, size_t num_columns, const rrcb_column* columns,
                      const rrcb_transfer_options* options) {
    return guarded_together(CallName::reply, ghosts, [&](const auto& own, Participant& self) {
        const rrcb::c::ColumnCall call{num_columns, columns, options};
        call.move_by(rrcb::detail::Replies{own.plan}, rrcb::total(own.plan.receive),
                     own.plan.send_indices.size(), self);
    });
}

int rrcb_ghosts_accumulate(const rrcb_ghosts* ghosts, size_t num_columns,
                           const rrcb_column* columns, const rrcb_transfer_options* options) {
    return guarded_together(CallName::accumulate, ghosts, [&](const auto& own, Participant& self) {
        std::vector<rrcb_column> given;
        rrcb::c::GivenTransferOptions within;
        self.attempt([&] {
            given = rrcb::c::given_columns(columns, num_columns);
            within = rrcb::c::GivenTransferOptions(options);
        });
        rrcb::TransferReport made;
        rrcb::c::accumulate(own, given, {within.max_bytes, &made}, self);
        within.store(made);
    });
}

int rrcb_ghosts_verify(rrcb_ghosts* ghosts, const rrcb_points* points,
                       const rrcb_verify_options* options, rrcb_verification* seen) {
    return guarded_together(CallName::verify, ghosts, [&](auto& own, Participant& self) {
        rrcb::c::verify(own, points, options, seen, self);
    });
}

int rrcb_ghosts_apply_shifts(const rrcb_ghosts* ghosts, const rrcb_points* positions) {
    return guarded(ghosts, [&](const auto& own) {
        rrcb::detail::apply_shifts(own.plan, rrcb::c::points_of(positions));
    });
}
