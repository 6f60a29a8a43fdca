#pragma once

#include "particles/stress.hpp"

#include <array>

namespace mpm {

/// Principal values in descending order, Pa.
using Principal = std::array<double, 3>;

/// Return of principal stresses to Tresca's hexagon, (largest - smallest) / 2 <= strength.
///
/// It ends at the nearest point at the same mean stress: on a side, or beyond the ends of a side at
/// a corner. So does associated plastic flow of an isotropic elastic solid, which keeps its volume
/// (de Souza Neto, Peric and Owen 2008, 8.1).
Principal returned_to_tresca(double strength, const Principal& trial);

/// Return of a stress, which keeps its principal axes. In plane strain one of them is z.
template <int D>
Stress<D> returned_to_tresca(double strength, const Stress<D>& trial);

/// Largest shear stress in any plane, half the difference of the first and last principal stress.
template <int D>
double largest_shear(const Stress<D>& stress);

}  // namespace mpm
