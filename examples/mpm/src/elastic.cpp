#include <mpm/effects.hpp>
#include <mpm/elastic.hpp>

namespace mpm {

StressColumns add_stress_columns(Particles& particles) {
    return {.xx = particles.add_column("stress_xx"),
            .yy = particles.add_column("stress_yy"),
            .zz = particles.add_column("stress_zz"),
            .xy = particles.add_column("stress_xy")};
}

PointKernel elastic_kernel(const Elastic& elastic, const StressColumns& columns) {
    return [bulk = elastic.bulk_modulus(), shear = elastic.shear_modulus(), columns](
               Particles& particles, const PointBlock& block) {
        double* __restrict xx = particles.data(columns.xx) + block.begin;
        double* __restrict yy = particles.data(columns.yy) + block.begin;
        double* __restrict zz = particles.data(columns.zz) + block.begin;
        double* __restrict xy = particles.data(columns.xy) + block.begin;
        const VelocityGradients& velocity = block.gradients;
        const double time_step = block.time_step;
        for (std::size_t p = 0; p < block.end - block.begin; ++p) {
            const DisplacementGradient gradient{
                time_step * velocity.xx[p], time_step * velocity.xy[p], time_step * velocity.yx[p],
                time_step * velocity.yy[p]};
            const Stress stress =
                strained(rotated({xx[p], yy[p], zz[p], xy[p]}, gradient), gradient, bulk, shear);
            xx[p] = stress.xx;
            yy[p] = stress.yy;
            zz[p] = stress.zz;
            xy[p] = stress.xy;
        }
    };
}

}  // namespace mpm
