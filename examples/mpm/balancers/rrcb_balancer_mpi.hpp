#pragma once

#include <rrcb/options.hpp>

#include <mpm/decomposition.hpp>

/// The balancer rrcb::balance, as the simulation takes it.
mpm::Balancer rrcb_balancer(const rrcb::Options& options = {});
