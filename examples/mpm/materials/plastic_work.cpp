#include "materials/plastic_work.hpp"

#include "materials/elastic.hpp"

#include <array>
#include <memory>

namespace mpm {

namespace {

/// Stress a + factor * b.
template <int D>
Stress<D> sum(Stress<D> a, double factor, const Stress<D>& b) {
    a.xx += factor * b.xx;
    a.yy += factor * b.yy;
    a.zz += factor * b.zz;
    a.xy += factor * b.xy;
    if constexpr (D == 3) {
        a.yz += factor * b.yz;
        a.zx += factor * b.zx;
    }
    return a;
}

/// Double contraction of two stresses.
template <int D>
double contraction(const Stress<D>& a, const Stress<D>& b) {
    double sum = a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2 * a.xy * b.xy;
    if constexpr (D == 3) sum += 2 * (a.yz * b.yz + a.zx * b.zx);
    return sum;
}

/// Work by volume of a stress on the elastic strain of another.
template <int D>
double work_on_strain_of(const Stress<D>& other, const Stress<D>& stress, double bulk,
                         double shear) {
    const double mean_other = mean(other), mean_stress = mean(stress);
    return mean_other * mean_stress / bulk +
           contraction(deviator(other, mean_other), deviator(stress, mean_stress)) / (2 * shear);
}

/// Stresses of a block before a return.
template <int D>
using Trials = std::array<Stress<D>, block_size>;

template <int D>
PointKernel<D> note_kernel(const StressColumns<D>& columns,
                           const std::shared_ptr<Trials<D>>& trials) {
    return [=](Particles& particles, const PointBlock<D>& block) {
        const StressPointers<D> stresses = stress_pointers<D>(particles, columns);
        for (std::size_t k = 0; k < block.size(); ++k)
            (*trials)[k] = load<D>(stresses, block.begin + k);
    };
}

template <int D>
PointKernel<D> sum_kernel(const Elastic& elastic, const StressColumns<D>& columns, Column volume,
                          Column work, const std::shared_ptr<Trials<D>>& trials) {
    return [=, bulk = elastic.bulk_modulus(), shear = elastic.shear_modulus()](
               Particles& particles, const PointBlock<D>& block) {
        const StressPointers<D> stresses = stress_pointers<D>(particles, columns);
        const StepGradients<D> gradients(block);
        const double* const volumes = particles.data(volume);
        double* const works = particles.data(work);
        for (std::size_t k = 0; k < block.size(); ++k) {
            const std::size_t p = block.begin + k;
            const Stress<D> trial = (*trials)[k], end = load<D>(stresses, p);
            const Stress<D> start = strained(trial, gradients[k], -bulk, -shear);
            works[p] += 0.5 * volumes[p] *
                        work_on_strain_of(sum(trial, -1, end), sum(start, 1, end), bulk, shear);
        }
    };
}

}  // namespace

template <int D>
void add_plastic_work(const Material& material, Particles& particles, Column work,
                      MaterialModel<D>& model) {
    if (model.kernels.size() < 2) return;
    const StressColumns<D> columns = add_stress_columns<D>(particles);
    const auto trials = std::make_shared<Trials<D>>();
    const Named<PointKernel<D>> note{"plastic_work", note_kernel<D>(columns, trials)};
    const Column volume = particles.add_column("volume");
    model.kernels.insert(model.kernels.begin() + 1, note);
    model.kernels.push_back({"plastic_work", sum_kernel<D>(elastic_of(values_of(material, D)),
                                                           columns, volume, work, trials)});
}

template void add_plastic_work<2>(const Material&, Particles&, Column, MaterialModel<2>&);
template void add_plastic_work<3>(const Material&, Particles&, Column, MaterialModel<3>&);

}  // namespace mpm
