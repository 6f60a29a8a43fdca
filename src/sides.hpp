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

}  // namespace rrcb
