#include "transfer/transfers_of.hpp"

namespace mpm {

GimpShape::GimpShape(const Scene& scene) {
    for (std::size_t a = 0; a < half_size.size(); ++a)
        half_size[a] = 0.5 / scene.bodies.front().points_per_cell[a];
}

template std::unique_ptr<Transfers<2>> make_transfers<2>(const Scene&, const FlipShare&,
                                                         Particles&);

}  // namespace mpm
