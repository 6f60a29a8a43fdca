#pragma once

#include "case_mpi.hpp"

#include <rrcb/cuts.hpp>

#include <string>
#include <vector>

// Each returns what is wrong, or nothing. `parts` holds the part of every point of the cloud.
namespace rrcb::test {

/// True when cuts are sought by weight in the points themselves, so that bounds can be stated.
bool is_exact(const Options& options);
bool is_to_tolerance(const Options& options);

/// Weights as they are balanced: counts where no point has weight.
std::vector<double> balanced_weights(const Cloud& cloud);

/// Weight of the heaviest set of points that no cut may divide: those in one place, or with
/// `plain_cuts` those in one plane.
double heaviest_object(const Cloud& cloud, bool plain_cuts);

/// Every cut leaves below it the share of the parts there, within the weight of one object.
std::string fault_of_exact_cuts(const Cloud& cloud, const std::vector<Part>& parts,
                                const Options& options);

/// No part is heavier than the tolerance allows, but for one object at each cut above it.
std::string fault_of_heaviest_part(const Cloud& cloud, const std::vector<Part>& parts,
                                   const Options& options, double tolerance);

/// All parts are in 0 ... num_parts - 1.
std::string fault_of_range(const std::vector<Part>& parts, int num_parts);

/// Look-ups of a point, and of boxes around nothing but it, find the part it was assigned to.
std::string fault_of_look_ups(const Cloud& cloud, const std::vector<Part>& parts, const Cuts& cuts);

}  // namespace rrcb::test
