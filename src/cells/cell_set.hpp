#pragma once

#include <rrcb/method/moments.hpp>

#include <cstddef>
#include <limits>
#include <vector>

namespace rrcb {

/// Cells of several ranks, of their support meshes or of a lattice.
///
/// The lattice of an exponent e divides all of space into cubes with edges of 2^e and corners at
/// multiples of 2^e. The cubes of a greater exponent are therefore unions of those of a smaller
/// one.
struct CellSet {
    std::vector<CellMoments> cells;
    int exponent = no_lattice;  ///< the greatest of those that cells were merged on

    static constexpr int no_lattice = std::numeric_limits<int>::min();
};

}  // namespace rrcb
