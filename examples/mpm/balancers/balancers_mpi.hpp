#pragma once

#include "balancers/rrcb_balancer_mpi.hpp"

#include <mpm/decomposition.hpp>
#include <mpm/scene.hpp>

#include <optional>
#include <string>

/// Names that make_balancer knows, with commas between them.
std::string balancer_names();

/// Balancer of a name; none for `none`, which leaves the equal slabs of the start.
///
/// The simulation asks for one box a rank: it lays a rank's grid over its box, and a point stays
/// with its rank until it leaves the box. Throws std::invalid_argument for a method whose parts are
/// no boxes, and for an unknown name. Zoltan_Initialize must have been called. Not
/// collective. Balancers of rrcb start from the cuts of their last call. `scene` tells `rrcb-cells`
/// its cells and shape functions: it cuts on faces of cells alone, into parts as wide as the nodes
/// that a point reaches along each axis are many cells, so that nodes are shared with adjacent
/// ranks only. Only rrcb, rrcb-exact and rrcb-cells take weights.
std::optional<mpm::Balancer> make_balancer(const std::string& name, const mpm::Scene& scene = {},
                                           const PointWeights& weights = {});
