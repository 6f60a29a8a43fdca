#include "balancer_mpi.hpp"

#include "rrcb_balancer_mpi.hpp"
#include "zoltan_balancer_mpi.hpp"

namespace comparisons {

std::vector<double> interleaved(mpm::Positions positions) {
    const std::size_t dimension = positions.z.empty() ? 2 : 3;
    std::vector<double> coordinates;
    coordinates.reserve(dimension * positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const mpm::Vector at = positions[i];
        coordinates.insert(coordinates.end(), at.begin(), at.begin() + dimension);
    }
    return coordinates;
}

std::optional<mpm::Balancer> make_balancer(const Method& method) {
    if (method.lb_method == on_arrays) return rrcb_balancer(*method.options);
    if (method.lb_method != "RCB" && method.lb_method != "RRCB") return std::nullopt;
    return zoltan_balancer(zoltan_parameters(method, Lists::parts));
}

}  // namespace comparisons
