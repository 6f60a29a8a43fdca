#pragma once

#include <rrcb/options.hpp>

#include <mpm/decomposition.hpp>
#include <mpm/scene.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Returns the weights of the points that are to be divided. An empty function gives each weight 1.
using PointWeights = std::function<std::vector<double>()>;

/// Returns a balancer that calls rrcb::balance and is collective like it. With `reuses_cuts` each
/// call starts from the cuts of the previous one, which suits a loop over steps.
mpm::Balancer rrcb_balancer(const rrcb::Options& options = {}, const PointWeights& weights = {},
                            bool reuses_cuts = false);

/// Returns the names that make_balancer accepts, separated by commas.
std::string balancer_names();

/// Returns the balancer with a name. The name `none` has no balancer: the equal slabs of the start
/// are kept.
///
/// Not collective. Throws std::invalid_argument if the name is unknown, or if weights are passed to
/// a balancer that takes none. The balancers of rrcb start from the cuts of their previous call.
/// `rrcb-cells` cuts only on faces of the cells of `scene`, into parts at least as wide as a shape
/// function, so that only ranks of adjacent parts share nodes.
std::optional<mpm::Balancer> make_balancer(const std::string& name, const mpm::Scene& scene = {},
                                           const PointWeights& weights = {});
