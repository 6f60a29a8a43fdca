#pragma once

#include "effects/stages.hpp"

namespace mpm {

/// Adds the kernels that hold the nodes on the sides of the domain, `walls` before they move and
/// `friction` after; none where all sides are open.
///
/// Where shape functions reach beyond a roller or fixed wall, the sums of nodes there go to their
/// mirror images inside, with the signs that leave the wall at rest.
template <int D>
void add_walls(const Scene& scene, Stages<D>& stages);

/// Adds the kernels that hold the nodes with mass on the planes and behind them, after they have
/// moved; what walls hold stays held.
template <int D>
void add_planes(const Scene& scene, Stages<D>& stages);

/// Adds the kernels that move nodes beyond walls as their mirror images, after all that changes
/// those.
template <int D>
void add_images(const Scene& scene, Stages<D>& stages);

}  // namespace mpm
