#pragma once

#include <mpm/decomposition.hpp>

/// The balancer rrcb::balance with its default options, as the simulation takes it.
mpm::Balancer rrcb_balancer();
