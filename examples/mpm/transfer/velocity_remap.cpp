#include "transfer/velocity_remap.hpp"

#include "transfer/g2p.hpp"

namespace mpm {

namespace {

template <int D, class Shape>
class VelocityRemapOf final : public VelocityRemap<D> {
  public:
    VelocityRemapOf(const Scene& scene, const FlipShare& flip, Particles& particles)
        : shape_(scene), flip_(flip), motion_(add_motion_columns(particles, D)) {}

    void scatter(const Particles& particles, std::span<const CellRun<D>> runs, double time_step,
                 GridPatch<D>& patch) const override {
        for (NodeSums<D>& node : patch.sums) node.momentum = {};
        const auto offsets = node_offsets<D, Shape::num_nodes>(patch);
        const double flip_share = flip_.over(time_step);
        for (const CellRun<D>& run : runs) scatter_run(particles, run, offsets, flip_share, patch);
    }

  private:
    static constexpr std::size_t num_nodes = power(Shape::num_nodes, D);
    using Offsets = std::array<std::size_t, num_nodes>;

    void scatter_run(const Particles& particles, const CellRun<D>& run, const Offsets& offsets,
                     double flip_share, GridPatch<D>& patch) const {
        std::array<Components<D>, num_nodes> sums{};
        for (std::size_t p = run.begin; p < run.end; ++p) {
            const std::array<double, num_nodes> weights =
                weights_at(particles, run, patch.shape.spacing, p);
            const double mass = particles[motion_.mass][p];
            for (std::size_t a = 0; a < D; ++a) {
                double change = 0, of_grid = 0;
                for (std::size_t n = 0; n < num_nodes; ++n) {
                    const NodeMotion<D>& node = patch.motion[run.node + offsets[n]];
                    change += weights[n] * node.velocity_change[a];
                    of_grid += weights[n] * node.velocity[a];
                }
                const double velocity =
                    flip_velocity(flip_share, particles[motion_.velocity[a]][p], change, of_grid);
                for (std::size_t n = 0; n < num_nodes; ++n)
                    sums[n][a] += weights[n] * mass * velocity;
            }
        }
        for (std::size_t n = 0; n < num_nodes; ++n)
            for (std::size_t a = 0; a < D; ++a)
                patch.sums[run.node + offsets[n]].momentum[a] += sums[n][a];
    }

    std::array<double, num_nodes> weights_at(const Particles& particles, const CellRun<D>& run,
                                             double spacing, std::size_t p) const {
        std::array<Weights<Shape::num_nodes>, D> along;
        for (std::size_t a = 0; a < D; ++a)
            along[a] =
                shape_.at((particles[motion_.position[a]][p] - run.corner[a]) * (1 / spacing), a);
        std::array<double, num_nodes> weights;
        unrolled<num_nodes>([&](auto n) { weights[n] = weight_of<D, Shape::num_nodes, n>(along); });
        return weights;
    }

    Shape shape_;
    FlipShare flip_;
    MotionColumns motion_;
};

}  // namespace

template <int D>
std::unique_ptr<VelocityRemap<D>> make_velocity_remap(const Scene& scene, const FlipShare& flip,
                                                      Particles& particles) {
    if (!remaps_velocities(scene)) return nullptr;
    switch (scene.shape_function) {
        case ShapeFunction::linear:
            return std::make_unique<VelocityRemapOf<D, LinearShape>>(scene, flip, particles);
        case ShapeFunction::quadratic:
            return std::make_unique<VelocityRemapOf<D, QuadraticShape>>(scene, flip, particles);
        case ShapeFunction::gimp:
            break;
    }
    return std::make_unique<VelocityRemapOf<D, GimpShape>>(scene, flip, particles);
}

template <int D>
void strain_by_momentum(GridPatch<D>& patch) {
    for (std::size_t n = 0; n < patch.sums.size(); ++n) {
        if (!(patch.sums[n].mass > 0)) continue;
        for (std::size_t a = 0; a < D; ++a)
            patch.motion[n].strain_velocity[a] = patch.sums[n].momentum[a] / patch.sums[n].mass;
    }
}

template std::unique_ptr<VelocityRemap<2>> make_velocity_remap<2>(const Scene&, const FlipShare&,
                                                                  Particles&);
template std::unique_ptr<VelocityRemap<3>> make_velocity_remap<3>(const Scene&, const FlipShare&,
                                                                  Particles&);
template void strain_by_momentum<2>(GridPatch<2>&);
template void strain_by_momentum<3>(GridPatch<3>&);

}  // namespace mpm
