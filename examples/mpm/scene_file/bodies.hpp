#pragma once

#include "scene_file/list.hpp"

#include <mpm/scene.hpp>

namespace mpm {

/// Body of a list.
Body read_body(const List& list, int dimension);

/// Whole numbers of a list along the axes, each at least 1; 1 beyond the dimension.
std::array<int, 3> whole_numbers(const List& list, const std::string& name,
                                 const std::vector<double>& numbers);

}  // namespace mpm
