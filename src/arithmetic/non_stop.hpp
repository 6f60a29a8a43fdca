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

    /// Calls a function of the caller's, which must not throw, in the caller's environment.
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
