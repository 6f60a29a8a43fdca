#include "materials/herschel_bulkley.hpp"

#include "materials/elastic.hpp"

namespace mpm {

namespace {

template <int D>
MaterialModel<D> build(const Values& values, Particles& particles) {
    MaterialModel<D> model = elastic_model<D>(values, particles);
    const HerschelBulkley fluid{values.number("yield_stress"), values.number("consistency"),
                                values.number("exponent")};
    const double shear_modulus = elastic_of(values).shear_modulus();
    const StressColumns<D> columns = add_stress_columns<D>(particles);
    const auto kernel = [=](Particles& points, const PointBlock<D>& block) {
        const StressPointers<D> stresses = stress_pointers<D>(points, columns);
        const double stiffness = shear_modulus * block.time_step;
        for (std::size_t p = block.begin; p < block.end; ++p)
            store<D>(returned<D>(fluid, stiffness, load<D>(stresses, p)), stresses, p);
    };
    model.kernels.push_back({"herschel_bulkley", kernel});
    return model;
}

}  // namespace

/// An elastic fluid. Its viscosity is implicit, so it does not limit the time step.
MaterialKind herschel_bulkley_material() {
    return {"herschel_bulkley",
            elastic_rules({not_negative("yield_stress", "Pa"),
                           not_negative("consistency", "Pa s^exponent"),
                           within("exponent", "", 0.1, 10, 1.0)}),
            elastic_wave_speed, build<2>, build<3>};
}

}  // namespace mpm
