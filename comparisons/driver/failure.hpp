#pragma once

#include <stdexcept>

namespace comparisons {

/// A mistake of the user's or a step that cannot go on; collective functions throw it on every
/// rank alike.
class Failure : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace comparisons
