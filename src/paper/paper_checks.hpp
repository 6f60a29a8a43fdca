#pragma once

#include <rrcb/paper.hpp>

#include <span>

namespace rrcb {

/// Throws Error for options of the sampling that are out of range.
void check_sampling(const PaperOptions& options);

/// Throws Error for sizes that Options::part_sizes could not be.
void check_sizes(int num_parts, std::span<const double> part_sizes);

}  // namespace rrcb
