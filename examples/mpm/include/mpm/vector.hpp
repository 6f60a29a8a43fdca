#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>

namespace mpm {

/// A position, velocity or force. In two dimensions the third component is 0.
using Vector = std::array<double, 3>;

/// A closed axis-aligned box in metres. Open sides are +-infinity. A box with a lower bound above
/// the upper one is empty.
struct Box {
    Vector lower{};
    Vector upper{};
};

/// A box with all sides open.
inline constexpr Box everywhere{
    {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
     -std::numeric_limits<double>::infinity()},
    {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
     std::numeric_limits<double>::infinity()}};

inline bool contains(const Box& box, const Vector& at) {
    return at[0] >= box.lower[0] && at[0] <= box.upper[0] && at[1] >= box.lower[1] &&
           at[1] <= box.upper[1] && at[2] >= box.lower[2] && at[2] <= box.upper[2];
}

/// A view of the positions of material points in metres, as columns of the same length. In two
/// dimensions `z` is empty.
struct Positions {
    std::span<const double> x;
    std::span<const double> y;
    std::span<const double> z = {};
    int dimension = z.empty() ? 2 : 3;  ///< pass 3 explicitly if a three-dimensional rank may have
                                        ///< no points

    std::size_t size() const { return x.size(); }
    Vector operator[](std::size_t point) const {
        return {x[point], y[point], z.empty() ? 0 : z[point]};
    }
};

}  // namespace mpm
