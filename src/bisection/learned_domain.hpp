#pragma once

#include "cells/cell_set.hpp"

#include <rrcb/statistical_domain.hpp>

namespace rrcb {

/// learned_domain() of the cells of several meshes; merged ones as analytic_domain() has them.
StatisticalDomain learned_domain(const CellSet& set, int dimension, const Box& box);

}  // namespace rrcb
