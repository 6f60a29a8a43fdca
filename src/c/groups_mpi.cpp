#include "c/columns.hpp"
#include "c/handle_mpi.hpp"
#include "lists/duplicated_mpi.hpp"

#include <algorithm>

struct rrcb_groups {
    MPI_Comm comm = MPI_COMM_NULL;
    rrcb::Groups groups{};
};

namespace {

using rrcb::Participant;
using rrcb::c::guarded;
using rrcb::c::require;
using rrcb::mpi::duplicate_of;

/// Runs the body of a function of groups.
template <class Body>
int with(const rrcb_groups* groups, Body&& body) noexcept {
    return guarded(
        groups, [&](const rrcb_groups& own) { body(own.groups, own.comm); }, "groups");
}

void make_groups(const rrcb_balancer& own, const rrcb_points* given, const uint64_t* keys,
                 int place, rrcb_groups** groups) {
    auto made = rrcb::c::make_handle(own.comm, groups, "groups");
    Participant self{duplicate_of(own.comm)};
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
    return guarded(balancer,
                   [&](const auto& own) { make_groups(own, points, keys, place, groups); });
}

void rrcb_groups_destroy(rrcb_groups* groups) {
    delete groups;
}

int rrcb_groups_points(const rrcb_groups* groups, rrcb_points* points) {
    return with(groups, [&](const rrcb::Groups& own, MPI_Comm) {
        require(points, "points");
        *points = rrcb_interleaved_points(RRCB_DOUBLE, own.dimension, own.weights.size(),
                                          own.coordinates.data(), own.weights.data());
    });
}

int rrcb_groups_fetch(const rrcb_groups* groups, size_t num_columns, const rrcb_column* columns,
                      const rrcb_transfer_limits* limits, rrcb_transfer_report* report) {
    return with(groups, [&](const rrcb::Groups& own, MPI_Comm comm) {
        Participant self{duplicate_of(comm)};
        const rrcb::c::ColumnCall call{num_columns, columns, limits, report};
        call.move_by(own, own.weights.size(), self);
    });
}

int rrcb_groups_sums(const rrcb_groups* groups, size_t components, const double* values,
                     double* sums) {
    return with(groups, [&](const rrcb::Groups& own, MPI_Comm comm) {
        Participant self{duplicate_of(comm)};
        const std::size_t length = own.of_points.size() * components;
        self.attempt([&] {
            rrcb::c::require_array(length, values, "values");
            rrcb::c::require_array(own.weights.size() * components, sums, "sums");
        });
        std::ranges::copy(rrcb::sums(own, rrcb::c::view(values, length), components, self), sums);
    });
}
