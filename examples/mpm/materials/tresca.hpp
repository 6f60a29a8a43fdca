#pragma once

#include "particles/stress.hpp"

#include <array>

namespace mpm {

/// Principal values in descending order, Pa.
using Principal = std::array<double, 3>;

/// What principal stresses return to on Tresca's hexagon, (first - last) / 2 <= strength: the
/// nearest point of it at the same mean stress, on a side or, beyond its ends, at a corner.
///
/// That is where plastic flow of an isotropic elastic solid ends, associated and so without change
/// of volume (de Souza Neto, Peric and Owen 2008, 8.1).
Principal returned_to_tresca(double strength, const Principal& trial);

/// The same for a stress, whose principal axes stay; in plane strain one of them is z.
template <int D>
Stress<D> returned_to_tresca(double strength, const Stress<D>& trial);

/// Largest shear stress in any plane, half the difference of the first and last principal stress.
template <int D>
double largest_shear(const Stress<D>& stress);

}  // namespace mpm
