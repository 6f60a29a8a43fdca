#pragma once

#include <cfenv>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace rrcb::hard_test {

/// Sets the floating-point environment of this rank for a scope.
class FloatingPoint {
  public:
    FloatingPoint() { std::fegetenv(&before_); }
    FloatingPoint(const FloatingPoint&) = delete;
    FloatingPoint& operator=(const FloatingPoint&) = delete;
    ~FloatingPoint() { std::fesetenv(&before_); }

    void round(int mode) { std::fesetround(mode); }

    /// Subnormal results become 0, and subnormal operands count as 0, where the machine can.
    void flush_subnormals() {
#ifdef __SSE2__
        constexpr unsigned flush_to_zero_and_denormals_are_zero = 0x8040;
        _mm_setcsr(_mm_getcsr() | flush_to_zero_and_denormals_are_zero);
#endif
    }

  private:
    std::fenv_t before_{};
};

}  // namespace rrcb::hard_test
