#pragma once

#include "effects/stages.hpp"

namespace mpm {

/// Places of the points that the probes of a scene follow, at the start.
std::vector<Vector> probed_points(const Scene& scene);

/// Column of the points: 1 + the number of the first probe that follows it, 0 for most.
inline constexpr const char* probe_column = "probe";

/// Columns of strain, as those of stress. In two dimensions strain_zz is 0.
template <int D>
StressColumns<D> add_strain_columns(Particles& particles);

/// Adds the columns that probes need, and the kernel that sums up the strain of their points.
///
/// Strain is the sum of the strains of all steps, turned with the material as the stress is.
template <int D>
void add_probes(const Scene& scene, Particles& particles, Stages<D>& stages);

}  // namespace mpm
