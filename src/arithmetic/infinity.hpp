#pragma once
#include <limits>

namespace rrcb {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace rrcb
