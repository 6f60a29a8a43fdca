#include <mpm/effects.hpp>

namespace mpm {

Effects build_effects(const Scene& scene, Particles& particles) {
    const StressColumns stress = add_stress_columns(particles);
    Effects effects;
    if (scene.gravity) effects.nodes.push_back({"gravity", gravity_kernel(*scene.gravity)});
    if (scene.damping) effects.nodes.push_back({"damping", damping_kernel(*scene.damping)});
    effects.nodes.push_back({"walls", wall_kernel(scene.walls)});
    effects.points.push_back({"elastic", elastic_kernel(scene.elastic, stress)});
    if (scene.mohr_coulomb)
        effects.points.push_back(
            {"drucker_prager", drucker_prager_kernel(matched_cone(*scene.mohr_coulomb), stress)});
    return effects;
}

}  // namespace mpm
