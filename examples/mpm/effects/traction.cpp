#include "effects/effect.hpp"
#include "scene/lattice.hpp"

#include <algorithm>

namespace mpm {

namespace {

/// Sides in the order of the axes, the lower before the upper one.
const std::vector<std::string> sides{"left", "right", "bottom", "top", "back", "front"};

/// The face that a traction acts on.
struct Face {
    std::size_t axis;
    double outward;  ///< +1 on an upper side, -1 on a lower one
    Box box;         ///< around its points at the start
};

template <int D>
Face read_face(const Values& values, const std::string& place) {
    const std::size_t side =
        static_cast<std::size_t>(std::ranges::find(sides, values.word("side")) - sides.begin());
    if (side >= 2 * D)
        throw std::invalid_argument(
            place + ": 'side' must be left, right, bottom or top in two dimensions");
    Face face{side / 2, side % 2 == 0 ? -1.0 : 1.0, everywhere};
    for (std::size_t a = 0; a < D; ++a) {
        if (values.has("lower")) face.box.lower[a] = values.list("lower")[a];
        if (values.has("upper")) face.box.upper[a] = values.list("upper")[a];
    }
    return face;
}

/// Area that the point at a position stands for on the face; 0 where it is not on it.
template <int D>
double area_at(const Scene& scene, const Face& face, const Vector& at) {
    if (!contains(face.box, at)) return 0;
    for (const Body& body : scene.bodies) {
        if (!body.contains(at)) continue;
        const Vector spacing = lattice_spacing(scene, body);
        Vector beyond = at;
        beyond[face.axis] += face.outward * spacing[face.axis];
        for (const Body& other : scene.bodies)
            if (other.contains(beyond)) return 0;
        return spacing[0] * spacing[1] * spacing[2] / spacing[face.axis];
    }
    return 0;
}

/// Throws std::invalid_argument for a face without points. All ranks look at all points.
template <int D>
void check_face(const Scene& scene, const Face& face, const std::string& place) {
    bool has_point = false;
    visit_points(scene, [&](const Body&, const Vector& at, std::int64_t) {
        has_point = has_point || area_at<D>(scene, face, at) > 0;
    });
    if (!has_point)
        throw std::invalid_argument(place +
                                    ": no outermost point of its 'side' lies in the box from "
                                    "'lower' to 'upper'; make that larger");
}

template <int D>
void build(const EffectBuilder<D>& builder) {
    const Values& values = builder.values;
    Stages<D>& stages = builder.stages;
    const std::string place = "effects / " + builder.name;
    const Face face = read_face<D>(values, place);
    check_face<D>(builder.scene, face, place);
    const MotionColumns motion = add_motion_columns(builder.particles, D);
    const Column area = builder.add_own_column("_area");
    stages.preparations.push_back([=, scene = builder.scene](Particles& particles) {
        const Positions positions = positions_of(particles, motion, D);
        for (std::size_t p = 0; p < particles.size(); ++p)
            particles.data(area)[p] = area_at<D>(scene, face, positions[p]);
    });
    const std::size_t field = stages.fields.size();
    stages.fields.push_back({builder.name, area});
    Components<D> traction;
    std::copy_n(values.list("traction").begin(), D, traction.begin());
    const double ramp = values.number("ramp");
    stages.forces.push_back({builder.name, [=](GridPatch<D>& patch, const StepTime& step) {
                                 Components<D> now = traction;
                                 for (double& component : now)
                                     component *= share_at(ramp, step.time);
                                 for (std::size_t n = 0; n < patch.sums.size(); ++n)
                                     for (std::size_t a = 0; a < D; ++a)
                                         patch.sums[n].force[a] += patch.fields[field][n] * now[a];
                             }});
}

}  // namespace

/// A force by area on the points of a face, the outermost of their bodies on one side at the start.
/// It keeps its direction and area.
EffectKind traction_effect() {
    Rule side{.name = "side", .kind = Rule::Kind::word, .choices = sides};
    return {"traction",
            {std::move(side), vector("traction", "Pa"), optional(vector("lower", "m")),
             optional(vector("upper", "m")), not_negative("ramp", "s", 0.0)},
            build<2>,
            build<3>,
            true};
}

}  // namespace mpm
