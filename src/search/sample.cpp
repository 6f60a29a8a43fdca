#include "search/sample.hpp"

#include "arithmetic/mix.hpp"

#include <algorithm>

namespace rrcb {

namespace {

constexpr double empty = -1;

/// Order of records: the greatest key first, equal keys by position, so that the order of joining
/// does not matter.
bool precedes(std::span<const double> a, std::span<const double> b) {
    return std::ranges::lexicographical_compare(b, a);
}

Vector position_of(std::span<const double> record) {
    Vector position{};
    std::ranges::copy(record.subspan(1), position.begin());
    return position;
}

}  // namespace

double sample_key(int rank, LocalIndex index) {
    const std::uint64_t key = mix(mix(static_cast<std::uint64_t>(rank) + 1) + index);
    return static_cast<double>(key >> 11);
}

void clear_sample(std::span<double> sample) {
    std::ranges::fill(sample, empty);
}

void add_to_sample(double key, const Vector& position, int dimension, std::span<double> sample) {
    const std::size_t length = sample_record(dimension);
    const std::size_t end = sample.size() / length * length;
    std::array<double, 1 + max_dimension> record{key};
    std::copy_n(position.begin(), dimension, record.begin() + 1);
    const auto incoming = std::span<const double>(record).first(length);
    std::size_t at = end;
    // The records from `at` on have lesser keys than the incoming one.
    while (at > 0 && precedes(incoming, sample.subspan(at - length, length))) at -= length;
    if (at == end) return;
    std::copy_backward(sample.begin() + at, sample.begin() + (end - length), sample.begin() + end);
    std::ranges::copy(incoming, sample.begin() + at);
}

void join_samples(std::span<const double> other, int dimension, std::span<double> sample) {
    const std::size_t length = sample_record(dimension);
    for (std::size_t at = 0; at + length <= other.size() && other[at] != empty; at += length)
        add_to_sample(other[at], position_of(other.subspan(at, length)), dimension, sample);
}

std::vector<Vector> positions_in(std::span<const double> sample, int dimension) {
    const std::size_t length = sample_record(dimension);
    std::vector<Vector> positions;
    for (std::size_t at = 0; at + length <= sample.size() && sample[at] != empty; at += length)
        positions.push_back(position_of(sample.subspan(at, length)));
    return positions;
}

}  // namespace rrcb
