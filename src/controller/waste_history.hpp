#pragma once

#include <array>
#include <cstddef>

namespace rrcb {

/// Steps since a rebalance in at most 64 stretches, which grow longer as steps come.
class WasteHistory {
  public:
    /// A step of mean load `work`, whose heaviest exceeds it by the factor `excess`.
    void add(double excess, double work);
    void clear() { *this = {}; }

    double work() const { return total_.work; }
    double waste() const { return total_.waste; }  ///< sum of excess * work

    /// Mean excess from the first stretch on that reached `level`; `level` where none did.
    ///
    /// So much of a level lasts, by what came after it before: all of what grows or jumps, but of
    /// what comes and goes the mean.
    double mean_since(double level) const;

    /// Sum of (excess - floor) work, of each step only so much excess as no stretch after it fell
    /// below.
    double lasting_waste(double floor) const;

  private:
    struct Stretch {
        double work = 0;
        double waste = 0;    ///< sum of excess * work
        double highest = 0;  ///< excess
        double lowest = 0;
    };

    static Stretch joined(const Stretch& a, const Stretch& b);
    std::size_t num_stretches() const { return num_full_ + (steps_in_last_ > 0 ? 1 : 0); }
    void halve();

    std::array<Stretch, 64> stretches_{};
    std::size_t num_full_ = 0;       ///< stretches before the one that grows
    std::size_t steps_in_last_ = 0;  ///< of that one
    std::size_t steps_in_each_ = 1;
    Stretch total_;
};

}  // namespace rrcb
