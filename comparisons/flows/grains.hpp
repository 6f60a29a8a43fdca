#pragma once

#include <rrcb/points.hpp>

#include <vector>

namespace comparisons {

/// Soft round grains of diameter and mass 1 on the ground, at 0 of their last axis, along which
/// they fall with an acceleration of 1.
struct Grains {
    int dimension = 2;
    double friction = 0;  ///< largest force along a contact over the force across it
    double wall = 0;      ///< walls at this place and at its negative on the first axis; 0: none
    std::vector<rrcb::Vector> x{}, v{};
};

/// Moves grains on by a time. Not collective.
void move(Grains& grains, double time);

}  // namespace comparisons
