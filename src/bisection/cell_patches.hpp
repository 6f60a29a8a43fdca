#pragma once

#include <rrcb/method/statistical_domain.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Weight of each cell, or its count where no cell has weight.
std::vector<double> weights_of(std::span<const CellMoments> cells);

/// Weight from which a cell counts as heavy among cells of these weights: cuts may divide one more
/// than once, and so few do that their patches are not many more than those of the others.
double least_heavy_weight(std::span<const double> weights, int dimension);

/// Appends the patches of a cell, of this weight, as analytic_domain() makes them; `box` holds all
/// points.
void append_patches(const CellMoments& cell, double weight, bool is_heavy, const Box& box,
                    StatisticalDomain& domain);

}  // namespace rrcb
