#pragma once

#include <stdexcept>

namespace comparisons {

/// A mistake of the user, or a step that cannot continue. Collective functions throw it on all
/// ranks.
class Failure : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace comparisons
