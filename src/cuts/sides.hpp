#pragma once

#include <rrcb/cuts.hpp>

namespace rrcb {

/// Sides of a cut that a box reaches; both only when the cut crosses it.
struct Sides {
    bool below;
    bool above;
};

inline Sides sides_of(const Box& box, const Cut& cut, int dimension) {
    return {!is_above(cut, box.lower, dimension), is_above(cut, box.upper, dimension)};
}

/// True when a closed box holds the place of points that lie on both sides of a cut.
inline bool holds_divided_points(const Box& box, const Cut& cut, int dimension) {
    if (cut.divides == 0) return false;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
        if (!(box.lower[a] <= cut.at[a] && cut.at[a] <= box.upper[a])) return false;
    return true;
}

}  // namespace rrcb
