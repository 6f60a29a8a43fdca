#include "c/columns.hpp"
#include "c/handle_mpi.hpp"
#include "lists/duplicated_mpi.hpp"

#include <rrcb/experimental/join_keys.h>

#include <algorithm>

struct rrcb_groups {
    static constexpr const char* name = "groups";
    MPI_Comm comm = MPI_COMM_NULL;
    rrcb::Groups groups{};
};

namespace {

using rrcb::CallName;
using rrcb::Participant;
using rrcb::c::guarded;
using rrcb::c::guarded_together;

void make_groups(const rrcb_balancer& own, const rrcb_points* given, const uint64_t* keys,
                 int place, rrcb_groups** groups, Participant& self) {
    auto made = rrcb::c::make_handle(self, groups);
    rrcb::Points points;
    self.attempt([&] {
        points = rrcb::c::points_of(given);
        rrcb::c::require_array(points.count, keys, "keys");
    });
    static_assert(RRCB_CENTRE == static_cast<int>(rrcb::GroupPlace::centre));
    made->comm = own.comm;
    made->groups = rrcb::groups(points, rrcb::c::view(keys, points.count),
                                static_cast<rrcb::GroupPlace>(place), self);
    *groups = made.release();
}

}  // namespace

int rrcb_groups_create(const rrcb_balancer* balancer, const rrcb_points* points,
                       const uint64_t* keys, int place, rrcb_groups** groups) {
    return guarded_together(CallName::groups, balancer, [&](const auto& own, Participant& self) {
        make_groups(own, points, keys, place, groups, self);
    });
}

int rrcb_join_keys(const rrcb_balancer* balancer, size_t count, size_t keys_per_point,
                   const uint64_t* keys, uint64_t* joined) {
    return guarded_together(CallName::join_keys, balancer, [&](const auto&, Participant& self) {
        self.attempt([&] {
            rrcb::c::require_array(count, keys, "keys");
            rrcb::c::require_array(count, joined, "joined");
            if (keys_per_point > SIZE_MAX / sizeof *keys / std::max<size_t>(count, 1))
                rrcb::reject(
                    "count and keys_per_point exceed the memory; count is the number of "
                    "points of this rank");
        });
        const auto given = rrcb::c::view(keys, self.failed() ? 0 : count * keys_per_point);
        std::ranges::copy(rrcb::experimental::join_keys(given, keys_per_point, self), joined);
    });
}

void rrcb_groups_destroy(rrcb_groups** groups) {
    rrcb::c::destroy(groups);
}

int rrcb_groups_points(const rrcb_groups* groups, rrcb_points* points) {
    return guarded(groups, [&](const auto& own) {
        rrcb::c::require_sized(points, "points");
        const rrcb::Groups& from = own.groups;
        rrcb::c::copy_out(rrcb_interleaved_points(RRCB_DOUBLE, from.dimension, from.weights.size(),
                                                  from.coordinates.data(), from.weights.data()),
                          points);
    });
}

int rrcb_groups_to_points(const rrcb_groups* groups, size_t num_columns, const rrcb_column* columns,
                          const rrcb_transfer_options* options) {
    return guarded_together(
        CallName::fetch_from_groups, groups, [&](const auto& own, Participant& self) {
            const rrcb::c::ColumnCall call{num_columns, columns, options};
            call.move_by(own.groups, own.groups.weights.size(), own.groups.of_points.size(), self);
        });
}

int rrcb_groups_sums(const rrcb_groups* groups, size_t components, const double* values,
                     double* sums) {
    return guarded_together(CallName::sums, groups, [&](const auto& own, Participant& self) {
        const rrcb::Groups& from = own.groups;
        const std::size_t length = from.of_points.size() * components;
        self.attempt([&] {
            rrcb::c::require_array(length, values, "values");
            rrcb::c::require_array(from.weights.size() * components, sums, "sums");
        });
        std::ranges::copy(rrcb::group_sums(from, rrcb::c::view(values, length), components, self),
                          sums);
    });
}
