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

    /// Calls a function of the caller, which must not throw, with the caller's floating-point
    /// environment.
    template <class Call>
    void outside(Call&& call) const {
        std::fenv_t inside;
        std::fegetenv(&inside);
        std::fesetenv(&before_);
        call();
        std::fegetenv(&before_);
        std::fesetenv(&inside);
    }

  private:
    mutable std::fenv_t before_;
};

}  // namespace rrcb
