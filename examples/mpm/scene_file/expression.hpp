#pragma once

#include <mpm/vector.hpp>

#include <functional>
#include <string>

namespace mpm {

/// A number at each position, infinite or NaN at some.
using Expression = std::function<double(const Vector&)>;

/// Expression of the coordinates x, y and, in three dimensions, z, in metres.
///
/// Operators and functions are muParser's, and pi; see the README. Throws std::invalid_argument
/// that tells the fault, its place in the text, and what is possible.
Expression parse_expression(const std::string& text, int dimension);

}  // namespace mpm
