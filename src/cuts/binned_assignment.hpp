#pragma once

#include "cells/binned_points.hpp"

#include <rrcb/cuts.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Part of every point by the cuts, into `parts` (length points.count), as the look-up has it: by
/// its cell and at most one comparison, but for points on a cut and in cells that several cuts
/// cross. Returns what each part weighs here.
std::vector<double> assign(const Cuts& cuts, const BinnedPoints& binned, std::span<Part> parts);

}  // namespace rrcb
