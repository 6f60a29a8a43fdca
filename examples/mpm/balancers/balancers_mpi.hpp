#pragma once

#include <rrcb/options.hpp>

#include <mpm/decomposition.hpp>
#include <mpm/scene.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Returns the weights of the points that are to be divided; none: each weighs 1.
using PointWeights = std::function<std::vector<double>()>;

/// Balancer by rrcb::balance, collective as that is. With `reuses_cuts` it starts from the cuts of
/// its last call, for a loop over steps.
mpm::Balancer rrcb_balancer(const rrcb::Options& options = {}, const PointWeights& weights = {},
                            bool reuses_cuts = false);

/// Names that make_balancer knows, with commas between them.
std::string balancer_names();

/// Makes the balancer of a name; none for `none`, which leaves the equal slabs of the start.
///
/// Not collective. Throws std::invalid_argument for an unknown name, and for weights if the
/// balancer takes none. Those of rrcb start from the cuts of their last call. `rrcb-cells` cuts
/// only on faces of the cells of `scene`, into parts as wide as a shape function, so that nodes are
/// shared with adjacent ranks only.
std::optional<mpm::Balancer> make_balancer(const std::string& name, const mpm::Scene& scene = {},
                                           const PointWeights& weights = {});
