#pragma once

#include "arithmetic/infinity.hpp"
#include "collective/agreement_mpi.hpp"
#include "lists/cutoff_access.hpp"
#include "options/rejection.hpp"

#include <rrcb/ghosts.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace rrcb {

/// Distances within which points are needed: the same for all, or one for each point.
struct Radii {
    double same = 0;  ///< NaN if not given
    std::optional<std::span<const double>> each{};
    Needs needs = Needs::scatter;

    /// Returns the distances of a cutoff. A rank without points need not give any.
    static Radii of_cutoff(const Cutoff& cutoff, Needs needs, LocalIndex num_points) {
        const std::optional<double>& of_all = detail::CutoffAccess::of_all(cutoff);
        Radii radii{of_all.value_or(std::numeric_limits<double>::quiet_NaN()),
                    detail::CutoffAccess::of_each(cutoff), needs};
        if (num_points == 0 && !of_all) radii.each.emplace();
        return radii;
    }

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
                "the cutoff must be finite, 0 or more; give one for all points, or one for each");
        require(each->size() == num_points, "cutoffs must have one entry for each point");
        require(std::ranges::all_of(*each, is_usable), "each cutoff must be finite, 0 or more");
    }

    /// Returns the common radius, as an argument for agree().
    Shared shared() const {
        return {"the cutoff", std::bit_cast<std::uint64_t>(same + 0.0), !each};
    }
    Shared each_given(LocalIndex num_points) const {
        return {"whether each point has a cutoff", each ? 1u : 0u, num_points > 0,
                "give one for each point on every rank that has points, or on none"};
    }
};

}  // namespace rrcb
