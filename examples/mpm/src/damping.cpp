#include <mpm/effects.hpp>

namespace mpm {

NodeKernel damping_kernel(const Damping& damping) {
    return [damping](GridPatch& patch, double time) {
        if (time >= damping.until) return;
        for (Node& node : patch.sums)
            for (std::size_t a = 0; a < 2; ++a) node.force[a] -= damping.rate * node.momentum[a];
    };
}

}  // namespace mpm
