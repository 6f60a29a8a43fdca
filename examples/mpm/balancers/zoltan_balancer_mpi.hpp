#pragma once

#include <mpm/decomposition.hpp>

/// Zoltan's RCB as the simulation takes it; Zoltan_Initialize must have been called. The handle
/// belongs to the communicator of the first call and is freed with the balancer.
mpm::Balancer zoltan_rcb_balancer();
