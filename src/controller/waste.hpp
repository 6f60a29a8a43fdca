#pragma once

#include <cstddef>

namespace rrcb {

/// Sums over some steps, in units of the first mean load.
struct Waste {
    double waste = 0;  ///< of heaviest - mean load
    double work = 0;   ///< of the mean loads

    double excess() const { return work > 0 ? waste / work : 0; }

    friend Waste operator+(const Waste& a, const Waste& b) {
        return {a.waste + b.waste, a.work + b.work};
    }
    friend Waste operator*(double factor, const Waste& a) {
        return {factor * a.waste, factor * a.work};
    }
};

/// Runs of steps have lengths 2^k of k below this: more steps than any program makes.
inline constexpr std::size_t num_lengths = 48;

/// Number of steps of length k.
inline double steps_of(std::size_t k) {
    return static_cast<double>(std::size_t{1} << k);
}

}  // namespace rrcb
