#pragma once

#include <rrcb/points.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

/// Doubles of one position in a sample: its key, then its coordinates.
constexpr std::size_t sample_record(int dimension) {
    return static_cast<std::size_t>(dimension) + 1;
}

/// Returns a random key, at least 0, for a point by its rank and its index there.
double sample_key(int rank, LocalIndex index);

// A sample holds as many records as `sample` has room for: those of the greatest keys, descending.
// Joining the samples of two disjoint sets of points gives the sample of their union, in any order
// of joining.

void clear_sample(std::span<double> sample);

/// Adds a position, unless `sample` is full of greater keys.
void add_to_sample(double key, const Vector& position, int dimension, std::span<double> sample);

/// Adds all positions of another sample of the same length.
void join_samples(std::span<const double> other, int dimension, std::span<double> sample);

std::vector<Vector> positions_in(std::span<const double> sample, int dimension);

}  // namespace rrcb
