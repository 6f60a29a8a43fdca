#include "hilbert.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace comparisons {

namespace {

using Axes = std::array<std::uint32_t, rrcb::max_dimension>;

Axes grid_cell(const rrcb::Box& box, const rrcb::Vector& position, int dimension) {
    Axes cell{};
    const double cells = 1 << hilbert_bits(dimension);
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
        const double extent = box.upper[a] - box.lower[a];
        const double place = extent > 0 ? (position[a] - box.lower[a]) / extent * cells : 0;
        cell[a] = static_cast<std::uint32_t>(std::clamp(place, 0.0, cells - 1));
    }
    return cell;
}

void transpose_to_hilbert(Axes& x, int dimension) {
    const auto n = static_cast<std::size_t>(dimension);
    const std::uint32_t top = 1U << (hilbert_bits(dimension) - 1);
    for (std::uint32_t q = top; q > 1; q >>= 1) {
        for (std::size_t i = 0; i < n; ++i) {
            if ((x[i] & q) != 0) {
                x[0] ^= q - 1;
            } else {
                const std::uint32_t t = (x[0] ^ x[i]) & (q - 1);
                x[0] ^= t;
                x[i] ^= t;
            }
        }
    }
    for (std::size_t i = 1; i < n; ++i) x[i] ^= x[i - 1];
    std::uint32_t t = 0;
    for (std::uint32_t q = top; q > 1; q >>= 1) {
        if ((x[n - 1] & q) != 0) t ^= q - 1;
    }
    for (std::size_t i = 0; i < n; ++i) x[i] ^= t;
}

}  // namespace

std::size_t hilbert_cell(const rrcb::Box& box, const rrcb::Vector& position, int dimension) {
    Axes x = grid_cell(box, position, dimension);
    transpose_to_hilbert(x, dimension);
    std::size_t place = 0;
    for (int bit = hilbert_bits(dimension) - 1; bit >= 0; --bit) {
        for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
            place = place << 1 | (x[a] >> bit & 1U);
        }
    }
    return place;
}

}  // namespace comparisons
