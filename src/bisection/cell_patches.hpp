#pragma once

#include <rrcb/method/statistical_domain.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Returns the weight of each cell, or its count if no cell has weight.
std::vector<double> weights_of(std::span<const CellMoments> cells);

/// Returns the weight above which a cell counts as heavy: cuts may divide it more than once. Few
/// cells are heavy, so their extra patches cost little.
double least_heavy_weight(std::span<const double> weights, int dimension);

/// Appends the patches of a cell as analytic_domain() describes; `box` holds all points.
void append_patches(const CellMoments& cell, double weight, bool is_heavy, const Box& box,
                    StatisticalDomain& domain);

}  // namespace rrcb
