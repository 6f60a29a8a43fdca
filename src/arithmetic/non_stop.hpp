#pragma once

#include <cfenv>

namespace rrcb {

/// Protects the caller from the floating-point exceptions raised in a scope: no exception traps,
/// and the caller's flags are restored at the end. Near the largest double, sums and extents
/// overflow to infinity by design.
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
