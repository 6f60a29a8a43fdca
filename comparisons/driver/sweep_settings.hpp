#pragma once

#include "method.hpp"

#include <vector>

namespace comparisons {

/// Every method and a grid of its parameters: from the fastest to the best balanced.
///
/// Of rrcb every support mesh, the automatic one among them, with every tolerance.
std::vector<Method> cost_settings();

/// The paper's parameters of rrcb-sampled: mesh 2 ... 10, k 1 ... 2.5, fraction 1 ... 1/8.
///
/// `quick` leaves the corners of mesh and fraction at the middle k.
std::vector<Method> paper_settings(bool quick);

/// The methods with their own settings, of those that a simulation can take; the paper's RRCB by
/// its name among the paper_settings.
std::vector<Method> standard_settings();

/// The settings of the paper beside the methods they are judged by.
std::vector<Method> study_settings(bool quick);

/// The settings with which the paper's RRCB was faster than its RCB.
std::vector<Method> winning_settings();

/// What is simulated more than once: the standard settings and the winning ones.
std::vector<Method> repeated_settings(bool quick);

/// What is called again and again on points that stand still: `rrcb-sampled` with box and cell
/// alike (k = sqrt(3)), smaller and larger, the winning settings, and methods to judge them by.
std::vector<Method> cycle_settings(bool quick);

}  // namespace comparisons
