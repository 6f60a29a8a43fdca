#pragma once

#include "effects/stages.hpp"

namespace mpm {

/// Holds the nodes on the sides of the domain: `walls` before they move, and `friction` after;
/// neither where all sides are open.
///
/// Where shape functions reach beyond a roller or fixed wall, what points hand to nodes there goes
/// to their mirror images inside, with the signs that leave the wall at rest.
template <int D>
void add_walls(const Scene& scene, Stages<D>& stages);

/// Holds the nodes with mass on the planes and behind them, after they have moved; nothing where
/// there is no plane. What walls hold stays held.
template <int D>
void add_planes(const Scene& scene, Stages<D>& stages);

/// Lets nodes beyond walls move as their mirror images; comes after all that changes those.
template <int D>
void add_images(const Scene& scene, Stages<D>& stages);

}  // namespace mpm
