#pragma once

#include "materials/material.hpp"

namespace mpm {

/// Adds kernels to a model that yields, which sum the work of stress on plastic strain in a column,
/// J; per metre of depth in two dimensions. None to a model that is elastic.
///
/// The plastic strain of a step is what the return takes from the trial stress, by the elastic
/// moduli. The work is that of the mean stress of the step: with the change of stored energy it
/// makes up the work on the whole strain.
template <int D>
void add_plastic_work(const Material& material, Particles& particles, Column work,
                      MaterialModel<D>& model);

}  // namespace mpm
