#include "balancers/balancers_mpi.hpp"

#ifdef RRCB_MPM_ZOLTAN
#include "balancers/zoltan_balancer_mpi.hpp"
#endif

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace {

constexpr std::array<std::string_view, 7> names{
    "none", "rrcb", "rrcb-exact", "rrcb-cells", "rrcb-sampled", "root-rcb", "zoltan-rcb"};

constexpr std::array<std::pair<std::string_view, std::string_view>, 3> without_boxes{{
    {"zoltan-rib", "RIB cuts along the axes of inertia"},
    {"zoltan-hsfc", "HSFC cuts along a curve"},
    {"zoltan2-mj", "those of multijagged need Zoltan2, which it does without"},
}};

[[noreturn]] void refuse(const std::string& name, const std::string& reason) {
    throw std::invalid_argument("--balancer: '" + name + "' " + reason +
                                "; choose from: " + balancer_names());
}

/// Limits the cuts to faces of cells, and the parts to the width of shape functions.
void cut_by_cells(const mpm::Scene& scene, rrcb::Options& options) {
    const int num_nodes = scene.shape_function == mpm::ShapeFunction::linear ? 2 : 3;
    const mpm::GridShape& grid = scene.grid;
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a) {
        options.axes.min_width.push_back(num_nodes * grid.spacing);
        options.axes.grid.push_back({grid.lower[a], grid.spacing});
    }
}

rrcb::Options options_of(const std::string& name, const mpm::Scene& scene) {
    rrcb::Options options;
    if (name == "rrcb-cells") cut_by_cells(scene, options);
    if (name == "rrcb-exact") options.refine = rrcb::Refine::exact;
    return options;
}

}  // namespace

std::string balancer_names() {
    std::string text;
    for (const std::string_view name : names)
        text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

std::optional<mpm::Balancer> make_balancer(const std::string& name, const mpm::Scene& scene,
                                           const PointWeights& weights) {
    for (const auto& [method, reason] : without_boxes) {
        if (name == method)
            refuse(name, "makes no boxes, which the simulation needs: " + std::string(reason));
    }
    if (std::ranges::find(names, name) == names.end()) refuse(name, "is not known");
    const bool takes_weights = name == "rrcb" || name == "rrcb-exact" || name == "rrcb-cells";
    if (weights && !takes_weights) refuse(name, "takes no weights, as --cost=learned gives them");
    if (name == "none") return std::nullopt;
    rrcb::PaperOptions paper;
    if (name == "root-rcb") paper.domain = rrcb::PaperDomain::points;
    if (name == "rrcb-sampled" || name == "root-rcb") return rrcb_balancer(paper);
    if (name != "zoltan-rcb") return rrcb_balancer(options_of(name, scene), weights, true);
#ifdef RRCB_MPM_ZOLTAN
    return zoltan_balancer({{"DEBUG_LEVEL", "0"}, {"LB_METHOD", "RCB"}, {"CHECK_GEOM", "0"}});
#else
    refuse(name, "is not there, because this was built without Zoltan");
#endif
}
