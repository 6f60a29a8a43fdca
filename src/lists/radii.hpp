#pragma once

#include "arithmetic/infinity.hpp"
#include "collective/agreement_mpi.hpp"
#include "options/rejection.hpp"

#include <rrcb/ghosts.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>

namespace rrcb {

/// Distances within which points are needed: the same for all, or one for each point.
struct Radii {
    double same = 0;
    std::optional<std::span<const double>> each{};
    Needs needs = Needs::scatter;

    double of(LocalIndex point) const { return each ? (*each)[point] : same; }

    double greatest() const {
        if (!each) return same;
        return each->empty() ? 0 : *std::ranges::max_element(*each);
    }

    /// Returns whether parts need other points within radii of their own points.
    bool are_of_receivers() const { return needs != Needs::scatter; }
    /// Returns the distance within which other ranks need a point because of the radius of that
    /// point.
    double of_sender(LocalIndex point) const {
        return needs == Needs::gather ? -infinity : of(point);
    }

    void check(LocalIndex num_points) const {
        const auto is_usable = [](double radius) { return std::isfinite(radius) && radius >= 0; };
        require(needs >= Needs::scatter && needs <= Needs::symmetric,
                "needs must be scatter, gather or symmetric");
        if (!each)
            return require(
                is_usable(same),
                "the radius must be finite, 0 or more; give it or radii, one for each point");
        require(std::isnan(same) || same == 0, "give one radius or radii, not both");
        require(each->size() == num_points, "radii must have one entry for each point");
        require(std::ranges::all_of(*each, is_usable), "each radius must be finite, 0 or more");
    }

    /// Returns the common radius, as an argument for agree().
    Shared shared() const {
        return {"the radius", std::bit_cast<std::uint64_t>(same + 0.0), !each};
    }
    Shared each_given(LocalIndex num_points) const {
        return {"whether radii are given", each ? 1u : 0u, num_points > 0,
                "give one for each point on every rank that has points, or on none"};
    }
};

}  // namespace rrcb
