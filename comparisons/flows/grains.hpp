#pragma once

#include <rrcb/points.hpp>

#include <vector>

namespace comparisons {

/// Soft round grains of diameter and mass 1. They fall with an acceleration of 1 along their last
/// axis onto the ground, at the coordinate 0.
struct Grains {
    int dimension = 2;
    double friction = 0;  ///< largest ratio of the forces along and normal to a contact
    double wall = 0;  ///< there are walls at this coordinate and its negative on the first axis; 0:
                      ///< none
    std::vector<rrcb::Vector> x{}, v{};
};

/// Advances the grains by a time. Not collective.
void move(Grains& grains, double time);

}  // namespace comparisons
