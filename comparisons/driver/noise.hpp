#pragma once

#include "row.hpp"
#include "statistics.hpp"

#include <ostream>
#include <span>
#include <string>

namespace comparisons {

/// How far a second measurement of the same thing is from the first: what times differ by alone.
struct Noise {
    std::string workload;
    std::string what;  ///< was measured twice
    Spread ratio;      ///< second / first of each turn
};

/// A row of noise.csv.
Row noise_row(const Noise& noise);

/// The same for people, a line each.
void print_noise(std::ostream& out, std::span<const Noise> noise);

}  // namespace comparisons
