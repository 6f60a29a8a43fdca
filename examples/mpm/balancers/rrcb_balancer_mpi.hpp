#pragma once

#include <rrcb/options.hpp>
#include <rrcb/paper.hpp>

#include <mpm/decomposition.hpp>

#include <functional>
#include <vector>

/// Returns the weights of the points that are to be divided; none: each weighs 1.
using PointWeights = std::function<std::vector<double>()>;

/// Balancer by rrcb::balance, collective as that is. With `reuses_cuts` it starts from the cuts of
/// its last call, for a loop over steps.
mpm::Balancer rrcb_balancer(const rrcb::Options& options = {}, const PointWeights& weights = {},
                            bool reuses_cuts = false);

/// Balancer by rrcb::balance_as_in_paper, collective as that is.
mpm::Balancer rrcb_balancer(const rrcb::PaperOptions& options);
