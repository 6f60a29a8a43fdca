#include "balance_mpi.hpp"
#include "c/balancer.hpp"
#include "c/for_fortran.h"
#include "c/handle_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/stamp_access.hpp"
#include "lists/duplicated_mpi.hpp"
#include "options/request.hpp"
#include "verbose_mpi.hpp"
#include "workspace_mpi.hpp"

#include <algorithm>
#include <vector>

namespace rrcb::c {

namespace {

/// Balances, starting from the cuts of the balancer if it has any. Collective.
void balance(const rrcb_points* from, int32_t* parts, rrcb_balancer& own, Participant& self) {
    Points points;
    Workspace* workspace = nullptr;
    self.attempt([&] {
        workspace = &workspace_of(self.comm);
        points = points_of(from);
        require_array(points.count, parts, "parts");
    });
    const double start = MPI_Wtime();
    Balance made = rrcb::balance(points, own.options, given(own.cuts), true, self,
                                 workspace ? std::move(workspace->result) : std::vector<Part>());
    print_line(made, own.options, start, self);
    std::ranges::copy(made.parts, parts);
    own.cuts = std::move(made.cuts);
    own.report = std::move(made.report);
    own.least_count = points.count;
    workspace->result = std::move(made.parts);
}

}  // namespace

}  // namespace rrcb::c

using rrcb::CallName;
using rrcb::Participant;
using rrcb::c::guarded_together;
using rrcb::c::require_cuts;

int rrcb_balancer_create(MPI_Comm comm, rrcb_balancer** balancer) {
    return rrcb::c::create(comm, CallName::create, balancer, [&](auto& own) { own.comm = comm; });
}

int rrcb_balancer_create_fortran(int comm, rrcb_balancer** balancer) {
    return rrcb_balancer_create(rrcb::c::comm_of(comm), balancer);
}

int rrcb_balance(rrcb_balancer* balancer, const rrcb_points* points, int32_t* parts) {
    return guarded_together(CallName::balance, balancer, [&](auto& own, Participant& self) {
        rrcb::c::balance(points, parts, own, self);
    });
}

int rrcb_assign_all(const rrcb_balancer* balancer, const rrcb_points* points, int32_t* parts) {
    return guarded_together(CallName::assign, balancer, [&](const auto& own, Participant& self) {
        rrcb::Points positions;
        self.attempt([&] {
            require_cuts(own);
            positions = rrcb::c::points_of(points);
            rrcb::c::require_array(positions.count, parts, "parts");
        });
        const std::vector<rrcb::Part> found = rrcb::assign(own.cuts, positions, self);
        std::ranges::copy(found, parts);
        own.lower_count(positions.count);
        rrcb::detail::StampAccess::points(own.cuts.stamp) =
            rrcb::hash_if_leaving(positions, found, own.cuts.num_parts,
                                  rrcb::mpi::rank_of(self.comm), rrcb::mpi::size_of(self.comm));
    });
}
