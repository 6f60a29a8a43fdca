#include "transfer/transfers_of.hpp"

namespace mpm {

namespace {

template <int D, class Shape>
std::unique_ptr<Transfers<D>> make(const Scene& scene, Particles& particles) {
    if (scene.transfer == Transfer::apic)
        return std::make_unique<TransfersOf<D, Shape, true>>(scene, particles);
    return std::make_unique<TransfersOf<D, Shape, false>>(scene, particles);
}

}  // namespace

GimpShape::GimpShape(const Scene& scene) {
    for (std::size_t a = 0; a < half_size.size(); ++a)
        half_size[a] = 0.5 / scene.bodies.front().points_per_cell[a];
}

template <int D>
std::unique_ptr<Transfers<D>> make_transfers(const Scene& scene, Particles& particles) {
    switch (scene.shape_function) {
        case ShapeFunction::linear:
            return make<D, LinearShape>(scene, particles);
        case ShapeFunction::quadratic:
            return make<D, QuadraticShape>(scene, particles);
        case ShapeFunction::gimp:
            break;
    }
    return std::make_unique<TransfersOf<D, GimpShape, false>>(scene, particles);
}

template std::unique_ptr<Transfers<2>> make_transfers<2>(const Scene&, Particles&);
template std::unique_ptr<Transfers<3>> make_transfers<3>(const Scene&, Particles&);

}  // namespace mpm
