#pragma once

#include <mpm/decomposition.hpp>

#include <string>
#include <utility>
#include <vector>

/// Names and values of Zoltan's parameters.
using ZoltanParameters = std::vector<std::pair<std::string, std::string>>;

/// Zoltan's RCB, by its parameters, as the simulation takes it.
///
/// It sets KEEP_CUTS, RETURN_LISTS and REMAP itself. The balancer is collective; a parameter that
/// Zoltan refuses, a method without boxes, or a failure on any rank throws std::runtime_error on
/// all ranks. The handle belongs to the communicator of the first call and is freed with the
/// balancer and its decompositions. Zoltan_Initialize must have been called.
mpm::Balancer zoltan_balancer(ZoltanParameters parameters);
