#include <mpm/drucker_prager.hpp>
#include <mpm/effects.hpp>

#include <algorithm>
#include <numbers>

namespace mpm {

DruckerPrager matched_cone(const MohrCoulomb& strength) {
    const double angle = strength.friction_angle * std::numbers::pi / 180;
    DruckerPrager cone{std::sin(angle), strength.cohesion * std::cos(angle),
                       strength.tension_cut_off};
    if (cone.friction > 0) cone.tension = std::min(cone.tension, cone.cohesion / cone.friction);
    return cone;
}

PointKernel drucker_prager_kernel(const DruckerPrager& cone, const StressColumns& columns) {
    return [cone, columns](Particles& particles, const PointBlock& block) {
        double* __restrict xx = particles.data(columns.xx) + block.begin;
        double* __restrict yy = particles.data(columns.yy) + block.begin;
        double* __restrict zz = particles.data(columns.zz) + block.begin;
        double* __restrict xy = particles.data(columns.xy) + block.begin;
        for (std::size_t p = 0; p < block.end - block.begin; ++p) {
            const Stress stress = returned(cone, {xx[p], yy[p], zz[p], xy[p]});
            xx[p] = stress.xx;
            yy[p] = stress.yy;
            zz[p] = stress.zz;
            xy[p] = stress.xy;
        }
    };
}

}  // namespace mpm
