#include "effects/penetrator/fluid_loads.hpp"

#include <limits>
#include <stdexcept>

namespace mpm {

namespace {

constexpr std::size_t vertical = 1;

template <int D>
BodyLoad<D> buoyancy(double density_in_domain, double level, const Gravity<D>& gravity) {
    return {[=](const Penetrator<D>& body, const StepTime& step) {
                return -density_in_domain * body.volume_below(level) *
                       gravity.acceleration[vertical] * gravity.share_at(step.time);
            },
            true};
}

/// Drag, implicit in the speed, so that it never turns the body back.
template <int D>
BodyLoad<D> drag(double factor, double level) {
    return {[=](const Penetrator<D>& body, const StepTime& step) {
        if (body.tip[vertical] > level) return 0.0;
        const double rate = factor * body.section() * std::abs(body.velocity);
        return -rate * body.velocity / (1 + step.time_step * rate / body.mass);
    }};
}

}  // namespace

template <int D>
std::vector<BodyLoad<D>> fluid_loads(const EffectBuilder<D>& builder, const Penetrator<D>& body) {
    const Values& values = builder.values;
    if (!values.has("fluid_density")) {
        for (const char* name : {"fluid_level", "drag_coefficient"})
            if (values.has(name))
                throw std::invalid_argument(std::string("effects / penetrator: '") + name +
                                            "' needs 'fluid_density' as well");
        return {};
    }
    const double density = values.number("fluid_density") * body.share_in(builder.scene.grid);
    const double level = values.has("fluid_level") ? values.number("fluid_level")
                                                   : std::numeric_limits<double>::infinity();
    std::vector<BodyLoad<D>> loads;
    if (builder.stages.gravity) loads.push_back(buoyancy(density, level, *builder.stages.gravity));
    if (values.has("drag_coefficient"))
        loads.push_back(drag<D>(0.5 * density * values.number("drag_coefficient"), level));
    return loads;
}

std::vector<Rule> fluid_rules() {
    return {optional(not_negative("fluid_density", "kg/m^3")), optional(number("fluid_level", "m")),
            optional(not_negative("drag_coefficient", ""))};
}

template std::vector<BodyLoad<2>> fluid_loads(const EffectBuilder<2>&, const Penetrator<2>&);
template std::vector<BodyLoad<3>> fluid_loads(const EffectBuilder<3>&, const Penetrator<3>&);

}  // namespace mpm
