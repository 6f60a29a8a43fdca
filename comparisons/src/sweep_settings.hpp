#pragma once

#include "method.hpp"

#include <vector>

namespace comparisons {

/// Every method and a grid of its parameters: from the fastest to the best balanced.
std::vector<Method> cost_settings();

/// The paper's parameters of rrcb-sampled: mesh 2 ... 10, k 1 ... 2.5, fraction 1 ... 1/8.
///
/// `quick` leaves the corners of mesh and fraction at the middle k.
std::vector<Method> paper_settings(bool quick);

}  // namespace comparisons
