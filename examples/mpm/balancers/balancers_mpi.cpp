#include "balancers/balancers_mpi.hpp"

#include "parallel/points.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/paper.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace {

constexpr std::array<std::string_view, 6> names{"none",       "rrcb",         "rrcb-exact",
                                                "rrcb-cells", "rrcb-sampled", "root-rcb"};

[[noreturn]] void refuse(const std::string& name, const std::string& reason) {
    throw std::invalid_argument("--balancer: '" + name + "' " + reason +
                                "; choose from: " + balancer_names());
}

/// Allows cuts on faces of cells only, and no parts narrower than a shape function.
void cut_by_cells(const mpm::Scene& scene, rrcb::Options& options) {
    const int num_nodes = scene.shape_function == mpm::ShapeFunction::linear ? 2 : 3;
    const mpm::GridShape& grid = scene.grid;
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a) {
        options.expert.axes.min_width.push_back(num_nodes * grid.spacing);
        options.expert.axes.grid.push_back({grid.lower[a], grid.spacing});
    }
}

/// Returns the closed box of a part. Points on a cut at a face of cells belong to the part above
/// it. The box below therefore ends slightly before the cut, and does not touch the cells beyond
/// it.
mpm::Box closed_box(const rrcb::Cuts& cuts, rrcb::Part part, bool on_faces) {
    rrcb::Box box = rrcb::box_of(cuts, part);
    for (double& face : box.upper)
        if (on_faces && std::isfinite(face))
            face = std::nextafter(face, -std::numeric_limits<double>::infinity());
    return {box.lower, box.upper};
}

/// Returns the decomposition of a balance. Moves the parts out of `balance`.
mpm::Decomposition decomposition_of(rrcb::Balance& balance, bool on_faces) {
    mpm::Decomposition decomposition;
    for (rrcb::Part part = 0; part < balance.cuts.num_parts; ++part)
        decomposition.boxes.push_back(closed_box(balance.cuts, part, on_faces));
    decomposition.local_owners = std::move(balance.parts);
    decomposition.owners = [cuts = balance.cuts](mpm::Positions at, std::span<int> owners) {
        rrcb::assign(cuts, mpm::points_of(at), owners);
    };
    return decomposition;
}

/// Returns a balancer by rrcb::balance_as_in_paper: RCB if `of_all_points`, RRCB otherwise.
mpm::Balancer paper_balancer(bool of_all_points) {
    rrcb::PaperOptions options;
    if (of_all_points) options.domain = rrcb::PaperDomain::points;
    return [options](mpm::Positions positions, MPI_Comm comm) {
        rrcb::Balance balance = rrcb::balance_as_in_paper(mpm::points_of(positions), comm, options);
        return decomposition_of(balance, false);
    };
}

}  // namespace

mpm::Balancer rrcb_balancer(const rrcb::Options& asked, const PointWeights& weights,
                            bool reuses_cuts) {
    rrcb::Options options = asked;
    // Every rank has the boxes of all ranks, so it looks owners up without communication.
    const auto last = std::make_shared<rrcb::Balance>();
    return [options, weights, reuses_cuts, last](mpm::Positions positions, MPI_Comm comm) {
        const std::vector<double> weight = weights ? weights() : std::vector<double>();
        rrcb::Points points = mpm::points_of(positions);
        points.weights = weight;
        if (!reuses_cuts) last->cuts = {};
        rrcb::balance_into(*last, points, comm, options, last->cuts);
        return decomposition_of(*last, !options.expert.axes.grid.empty());
    };
}

std::string balancer_names() {
    std::string text;
    for (const std::string_view name : names)
        text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

std::optional<mpm::Balancer> make_balancer(const std::string& name, const mpm::Scene& scene,
                                           const PointWeights& weights) {
    if (std::ranges::find(names, name) == names.end()) refuse(name, "is not known");
    const bool is_paper = name == "rrcb-sampled" || name == "root-rcb";
    if (weights && (is_paper || name == "none"))
        refuse(name, "takes no weights, as --cost=learned gives them");
    if (name == "none") return std::nullopt;
    if (is_paper) return paper_balancer(name == "root-rcb");
    rrcb::Options options;
    if (name == "rrcb-cells") cut_by_cells(scene, options);
    if (name == "rrcb-exact") options.refine = rrcb::Refine::exact;
    return rrcb_balancer(options, weights, true);
}
