#include "balancers/rrcb_balancer_mpi.hpp"

#include <rrcb/balance.hpp>

#include <array>
#include <memory>
#include <utility>

namespace {

rrcb::Points points_of(mpm::Positions positions) {
    const std::array<std::span<const double>, 3> columns{positions.x, positions.y, positions.z};
    return rrcb::column_points(std::span(columns).first(positions.z.empty() ? 2 : 3));
}

mpm::Decomposition decompose(mpm::Positions positions, const rrcb::Options& options,
                             MPI_Comm comm) {
    rrcb::Balance balance = rrcb::balance(points_of(positions), options, comm);
    mpm::Decomposition decomposition;
    for (rrcb::Part part = 0; part < balance.cuts.num_parts; ++part) {
        const rrcb::Box box = rrcb::box_of(balance.cuts, part);
        decomposition.boxes.push_back({box.lower, box.upper});
    }
    decomposition.local_owners = std::move(balance.parts);
    decomposition.owners = [cuts = std::move(balance.cuts)](mpm::Positions at,
                                                            std::span<int> owners) {
        rrcb::assign(cuts, points_of(at), owners);
    };
    return decomposition;
}

}  // namespace

mpm::Balancer rrcb_balancer(const rrcb::Options& options) {
    return [options](mpm::Positions positions, MPI_Comm comm) {
        return decompose(positions, options, comm);
    };
}
