#include "balancers/rrcb_balancer_mpi.hpp"

#include <rrcb/balance.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

namespace {

rrcb::Points points_of(mpm::Positions positions) {
    const std::array<std::span<const double>, 3> columns{positions.x, positions.y, positions.z};
    return rrcb::column_points(std::span(columns).first(positions.z.empty() ? 2 : 3));
}

/// The box of a part. A cut on a face of cells leaves the points on it above, so that the box below
/// ends before it and touches no cell beyond.
mpm::Box closed_box(const rrcb::Cuts& cuts, rrcb::Part part, bool on_faces) {
    rrcb::Box box = rrcb::box_of(cuts, part);
    for (double& face : box.upper)
        if (on_faces && std::isfinite(face))
            face = std::nextafter(face, -std::numeric_limits<double>::infinity());
    return {box.lower, box.upper};
}

/// The decomposition of a balance, whose parts it takes.
mpm::Decomposition decomposition_of(rrcb::Balance& balance, bool on_faces) {
    mpm::Decomposition decomposition;
    for (rrcb::Part part = 0; part < balance.cuts.num_parts; ++part)
        decomposition.boxes.push_back(closed_box(balance.cuts, part, on_faces));
    decomposition.local_owners = std::move(balance.parts);
    decomposition.owners = [cuts = balance.cuts](mpm::Positions at, std::span<int> owners) {
        rrcb::assign(cuts, points_of(at), owners);
    };
    return decomposition;
}

}  // namespace

mpm::Balancer rrcb_balancer(const rrcb::Options& asked, const PointWeights& weights,
                            bool reuses_cuts) {
    rrcb::Options options = asked;
    // Every rank has the boxes of all, and looks up owners by itself.
    options.cuts = rrcb::HeldCuts::whole;
    const auto last = std::make_shared<std::optional<rrcb::Balance>>();
    return [options, weights, reuses_cuts, last](mpm::Positions positions, MPI_Comm comm) {
        const std::vector<double> weight = weights ? weights() : std::vector<double>();
        rrcb::Points points = points_of(positions);
        points.weights = weight;
        if (reuses_cuts && last->has_value())
            rrcb::rebalance_into(**last, points, options, (*last)->cuts, comm);
        else
            *last = rrcb::balance(points, options, comm);
        return decomposition_of(**last, !options.axes.grid.empty());
    };
}

mpm::Balancer rrcb_balancer(const rrcb::PaperOptions& options) {
    return [options](mpm::Positions positions, MPI_Comm comm) {
        rrcb::Balance balance = rrcb::balance_as_in_paper(points_of(positions), options, comm);
        return decomposition_of(balance, false);
    };
}
