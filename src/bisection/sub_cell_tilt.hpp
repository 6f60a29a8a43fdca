#pragma once

#include "bisection/learned_prior.hpp"

#include <array>
#include <optional>

namespace rrcb {

/// Mean from the centre and standard deviation per axis, in cells.
struct CellSpread {
    std::array<double, 2> mean{};
    std::array<double, 2> deviation{};
};

/// Shares exp(prior + a x + b x^2 + c y + d y^2) of the sub-cells that, each of them even, have
/// this mean and this deviation; nothing where there are none, or hardly any. Not collective.
///
/// a ... d maximise the likelihood of the moments, a concave function: Csiszar, I-divergence
/// geometry of probability distributions (1975), by Newton's method.
std::optional<SubCells> tilted(const SubCells& prior, const CellSpread& spread);

}  // namespace rrcb
