#pragma once

#include <cfenv>

namespace rrcb {

/// Keeps the floating-point exceptions of a scope from the caller: none traps, and the caller's
/// flags are restored. Near the ends of a double's range, sums and extents overflow to infinity by
/// design.
class NonStop {
  public:
    NonStop() { std::feholdexcept(&before_); }
    NonStop(const NonStop&) = delete;
    NonStop& operator=(const NonStop&) = delete;
    ~NonStop() { std::fesetenv(&before_); }

  private:
    std::fenv_t before_;
};

}  // namespace rrcb
