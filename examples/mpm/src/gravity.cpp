#include <mpm/effects.hpp>

namespace mpm {

NodeKernel gravity_kernel(const Vector& acceleration) {
    return [acceleration](GridPatch& patch, double) {
        for (Node& node : patch.sums)
            for (std::size_t a = 0; a < 2; ++a) node.force[a] += node.mass * acceleration[a];
    };
}

}  // namespace mpm
