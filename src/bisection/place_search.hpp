#pragma once

#include "bisection/axis_choice.hpp"
#include "cuts/cut_limits.hpp"

#include <rrcb/statistical_domain.hpp>

#include <utility>
#include <vector>

namespace rrcb {

/// An axis that a cut may cross, and where.
struct Way {
    int axis;
    Places places;
};

/// The axes that have places for the cut of a node: `preferred`, then the others from the longest
/// of `extent` down.
std::vector<Way> ways_across(const Descent& at, const Box& region, const Box& extent, int preferred,
                             CutLimits& limits);

/// A node with what lies in it; patches only.
struct Piece {
    StatisticalDomain domain;
    Descent at;
    Box region;
    int depth;
};

/// Cuts of a node and what they make of its parts.
struct Outcome {
    double heaviest = 0;            ///< weight over size, of the part where it is greatest
    std::vector<Cut> tree{};        ///< in preorder
    std::vector<double> weights{};  ///< of the parts
};

/// Searches for even parts whose cuts lie in their places.
class PlaceSearch {
  public:
    /// All are borrowed; `domain` is the whole. There is room for the parts.
    PlaceSearch(CutLimits& limits, const AxisChoice& axis_of, const Options& options,
                const StatisticalDomain& domain);

    /// The cuts of a node. Without effort each is the best there is by itself; each level of effort
    /// looks one level farther ahead.
    Outcome solve(const Piece& piece, int effort);

    /// The same with the whole effort at every level.
    Outcome solve_all(const Piece& piece, int effort);

    /// True when other cuts would gain next to nothing.
    bool is_good(const Piece& piece, const Outcome& outcome) const;

    /// Levels to look ahead that so many patches and parts leave time for.
    static int affordable_effort(std::size_t num_patches, int dimension, int num_parts);

  private:
    /// A cut, and the weight below it.
    struct Trial {
        Cut cut;
        double below;
    };
    struct Solved {
        Outcome outcome;
        bool is_upper_heavier;
    };

    std::span<const double> sizes_of(const Descent& at) const;
    std::vector<Way> ways_of(const Piece& piece);
    Trial trial_in(const Piece& piece, int axis, double place) const;
    Trial trial_at(const Piece& piece, const Way& way, double target) const;
    Trial first_trial(const Piece& piece, const Way& way) const;
    Trial best_first_trial(const Piece& piece);
    Solved solve_halves(const Piece& piece, const Cut& cut, int effort);
    Outcome solve_beside_none(const Piece& piece, int effort);
    void look_along(const Piece& piece, const Way& way, int effort, Outcome& best);

    CutLimits& limits_;
    const AxisChoice& axis_of_;
    const Options& options_;
    double enough_;  ///< weight over size that needs no improvement
};

}  // namespace rrcb
