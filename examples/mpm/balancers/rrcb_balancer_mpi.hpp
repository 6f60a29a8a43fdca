#pragma once

#include <rrcb/options.hpp>

#include <mpm/decomposition.hpp>

/// Balancer by rrcb::balance, collective as that is.
mpm::Balancer rrcb_balancer(const rrcb::Options& options = {});
