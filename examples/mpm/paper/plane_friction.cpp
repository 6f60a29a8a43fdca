#include "boundaries/boundaries.hpp"
#include "particles/vectors.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

namespace mpm {

namespace {

template <int D>
double along_normal(const Components<D>& normal, const Components<D>& vector) {
    double across = 0;
    for (std::size_t a = 0; a < D; ++a) across += vector[a] * normal[a];
    return across;
}

/// Solid ground behind a plane.
template <int D>
struct Ground {
    explicit Ground(const Plane& plane) {
        double square = 0;
        for (std::size_t a = 0; a < D; ++a) square += plane.normal[a] * plane.normal[a];
        for (std::size_t a = 0; a < D; ++a) {
            normal[a] = plane.normal[a] / std::sqrt(square);
            level += normal[a] * plane.point[a];
        }
    }

    double height(const Components<D>& at) const { return along_normal<D>(normal, at) - level; }

    Components<D> normal;  ///< outward, of unit length
    double level = 0;      ///< along the normal, m
};

/// Columns of the points for friction on one plane.
template <int D>
struct FrictionColumns {
    std::array<Column, D> anchor{};  ///< anchor of the spring along the plane, m
    Column damping = 0;              ///< share of the dashpot in the force normal to the plane, N
};

/// Columns of the points for one plane. All points have them, also those far from the plane,
/// because columns migrate, are sorted and are written without further code. A list of the points
/// at the plane would need such code.
template <int D>
struct PlaneColumns {
    MotionColumns motion;
    std::array<Column, D> force{};  ///< force in the next step, N; 0 without contact
    Column reach = 0;               ///< height above the plane below which the point touches it, m
    std::optional<FrictionColumns<D>> friction{};
};

/// Consecutive points that are skipped together if all are far from the plane.
constexpr std::size_t seen_together = 32;

/// Columns that show which points touch the plane now or touched it in the previous step.
template <int D>
struct SeenPoints {
    SeenPoints(const Particles& particles, const PlaneColumns<D>& columns)
        : reach(particles[columns.reach].data()) {
        for (std::size_t a = 0; a < D; ++a) {
            position[a] = particles[columns.motion.position[a]].data();
            before[a] = particles[columns.force[a]].data();
        }
        before[D] = columns.friction ? particles[columns.friction->damping].data() : before[0];
    }

    std::array<const double*, D> position;
    std::array<const double*, D + 1> before;  ///< not all 0 on points that touched the plane
    const double* reach;
};

/// Returns whether any of the points touches the plane, or has forces of the previous step.
template <int D>
MPM_VECTOR_CLONES bool touches_any(const SeenPoints<D>& points, const Ground<D>& ground,
                                   std::size_t begin, std::size_t end) {
    std::uint64_t any = 0;
    for (std::size_t p = begin; p < end; ++p) {
        Components<D> at;
        for (std::size_t a = 0; a < D; ++a) at[a] = points.position[a][p];
        for (const double* value : points.before) any |= std::bit_cast<std::uint64_t>(value[p]);
        any |= points.reach[p] > ground.height(at) ? 1 : 0;
    }
    return any != 0;
}

/// A plane that acts on points through a layer of springs and, with friction, dashpots.
///
/// The plane acts on points because the nodes behind an inclined plane form a staircase: it shakes
/// a body that slides across, which then alternately sticks and slips. One spring carries the body,
/// and one along the plane holds it up to the limit of friction (Cundall and Strack 1979). A
/// dashpot with the impedance of the body absorbs its vibrations (Lysmer and Kuhlemeyer 1969). With
/// a quarter of this impedance a body near the limit of friction creeps. Planes without friction
/// have no dashpot, because it takes a fifth to a half of the energy of an impact.
template <int D>
class RubbingPlane {
  public:
    RubbingPlane(const Plane& plane, double wave_speed, double spacing,
                 const PlaneColumns<D>& columns)
        : ground_(plane),
          friction_(plane.friction),
          spacing_(spacing),
          rate_(wave_speed / spacing),
          columns_(columns) {}

    /// A point touches the plane when its distance is half its width. Points that start within
    /// their width of the plane touch it at that distance. Otherwise a body on an inclined plane
    /// would first fall until enough of its lowest points have reached the plane.
    void start(Particles& particles) const {
        for (std::size_t p = 0; p < particles.size(); ++p) {
            const double height = ground_.height(position_of(particles, p));
            const double width = width_of(particles, p);
            particles.data(columns_.reach)[p] = height < width ? height : 0.5 * width;
        }
    }

    /// Finds the forces of the next step on a block of points.
    void push(Particles& particles, const PointBlock<D>& block) const {
        const SeenPoints<D> seen(particles, columns_);
        for (std::size_t begin = block.begin; begin < block.end; begin += seen_together) {
            const std::size_t end = std::min(begin + seen_together, block.end);
            if (!touches_any<D>(seen, ground_, begin, end)) continue;
            for (std::size_t p = begin; p < end; ++p) push_point(particles, p, block.time_step);
        }
    }

  private:
    void push_point(Particles& particles, std::size_t p, double time_step) const {
        const Components<D> at = position_of(particles, p);
        const double depth = particles[columns_.reach][p] - ground_.height(at);
        double push = depth > 0 ? spring_of(particles, p, depth) : 0;
        Components<D> held{};
        if (columns_.friction) {
            double& damping = particles.data(columns_.friction->damping)[p];
            damping = depth > 0 ? std::max(damping_of(particles, p, time_step), -push) : 0;
            push += damping;
            if (push > 0) held = friction_on(particles, p, at, push, time_step);
        }
        for (std::size_t a = 0; a < D; ++a)
            particles.data(columns_.force[a])[p] = push * ground_.normal[a] + held[a];
    }

    Components<D> position_of(const Particles& particles, std::size_t p) const {
        Components<D> at;
        for (std::size_t a = 0; a < D; ++a) at[a] = particles[columns_.motion.position[a]][p];
        return at;
    }

    double width_of(const Particles& particles, std::size_t p) const {
        return std::pow(particles[columns_.motion.volume][p], 1.0 / D);
    }

    /// Returns the mass of a column of points as high as a cell, over the area that the point
    /// covers, kg.
    double mass_above(const Particles& particles, std::size_t p) const {
        return particles[columns_.motion.mass][p] * spacing_ / width_of(particles, p);
    }

    /// Returns the force of the spring normal to the plane, N. The spring stiffens with depth, so
    /// that points sink in by a few tenths of a cell at most.
    double spring_of(const Particles& particles, std::size_t p, double depth) const {
        constexpr double softness = 10;
        const double relative = softness * depth / spacing_;
        const double stiffness = rate_ * rate_ / softness * (1 + relative * relative);
        return mass_above(particles, p) * stiffness * depth;
    }

    /// Returns the force of the dashpot normal to the plane, N. In one step it changes the momentum
    /// by at most that of half a cell of points, which is the mass of a node on the plane.
    double damping_of(const Particles& particles, std::size_t p, double time_step) const {
        double across = 0;
        for (std::size_t a = 0; a < D; ++a)
            across += particles[columns_.motion.velocity[a]][p] * ground_.normal[a];
        return -mass_above(particles, p) * std::min(rate_, 0.5 / time_step) * across;
    }

    /// Returns the force along the plane, N. When the spring exceeds the friction, its anchor is
    /// dragged.
    Components<D> friction_on(Particles& particles, std::size_t p, const Components<D>& at,
                              double push, double time_step) const {
        const double stiffness =
            std::min(mass_above(particles, p) * rate_ * rate_,
                     particles[columns_.motion.mass][p] / (time_step * time_step));
        const std::array<Column, D>& anchor = columns_.friction->anchor;
        if (!touched(particles, p))
            for (std::size_t a = 0; a < D; ++a) particles.data(anchor[a])[p] = at[a];
        Components<D> stretch;
        for (std::size_t a = 0; a < D; ++a) stretch[a] = at[a] - particles[anchor[a]][p];
        const double across = along_normal<D>(ground_.normal, stretch);
        double square = 0;
        for (std::size_t a = 0; a < D; ++a) {
            stretch[a] -= across * ground_.normal[a];
            square += stretch[a] * stretch[a];
        }
        const double force = stiffness * std::sqrt(square), most = friction_ * push;
        const double share = force > most ? most / force : 1;
        Components<D> held;
        for (std::size_t a = 0; a < D; ++a) {
            held[a] = -share * stiffness * stretch[a];
            particles.data(anchor[a])[p] = at[a] - share * stretch[a];
        }
        return held;
    }

    bool touched(const Particles& particles, std::size_t p) const {
        for (std::size_t a = 0; a < D; ++a)
            if (particles[columns_.force[a]][p] != 0) return true;
        return false;
    }

    Ground<D> ground_;
    double friction_;
    double spacing_;
    double rate_;  ///< how often a wave crosses a cell, 1/s
    PlaneColumns<D> columns_;
};

/// Adds the columns of a plane, and their sums on the nodes.
template <int D>
PlaneColumns<D> add_columns(const std::string& plane, bool has_friction, Particles& particles,
                            Stages<D>& stages) {
    PlaneColumns<D> columns{.motion = add_motion_columns(particles, D),
                            .reach = particles.add_column(plane + "_reach")};
    for (std::size_t a = 0; a < D; ++a) {
        columns.force[a] = particles.add_column(plane + "_force_" + "xyz"[a]);
        stages.fields.push_back({"plane_friction", columns.force[a], static_cast<int>(a)});
    }
    if (!has_friction) return columns;
    FrictionColumns<D>& friction = columns.friction.emplace();
    friction.damping = particles.add_column(plane + "_damping");
    for (std::size_t a = 0; a < D; ++a)
        friction.anchor[a] = particles.add_column(plane + "_anchor_" + "xyz"[a]);
    stages.fields.push_back({"plane_friction", friction.damping});
    return columns;
}

/// Adds the forces of a plane to the nodes. The first of their fields has the number `first`.
///
/// In one step dashpots at most stop a node: a node that only few points reach has less mass than
/// the force of these points assumes. Friction is scaled like the force normal to the plane.
template <int D>
NodeKernel<D> force_kernel(const Ground<D>& ground, std::size_t first, bool has_friction) {
    return [=](GridPatch<D>& patch, const StepTime& now) {
        const double* const damping = has_friction ? patch.fields[first + D].data() : nullptr;
        for (std::size_t n = 0; n < patch.sums.size(); ++n) {
            NodeSums<D>& node = patch.sums[n];
            Components<D> force;
            for (std::size_t a = 0; a < D; ++a) force[a] = patch.fields[first + a][n];
            const double push = along_normal<D>(ground.normal, force);
            if (!(push > 0)) continue;
            double share = 1;
            if (has_friction) {
                const double stop = -along_normal<D>(ground.normal, node.momentum) / now.time_step;
                const double left =
                    std::clamp(damping[n], std::min(stop, 0.0), std::max(stop, 0.0));
                share = std::max(0.0, 1 - (damping[n] - left) / push);
            }
            for (std::size_t a = 0; a < D; ++a) node.force[a] += share * force[a];
        }
    };
}

}  // namespace

Scene with_ground(Scene scene) {
    Walls& walls = scene.walls;
    const std::array<std::array<Wall*, 2>, 3> sides{
        {{&walls.left, &walls.right}, {&walls.bottom, &walls.top}, {&walls.back, &walls.front}}};
    const std::array ends{scene.grid.lower, scene.grid.upper()};
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a)
        for (const std::size_t end : {0, 1}) {
            Wall& wall = *sides[a][end];
            if (wall.kind != Wall::frictional) continue;
            Plane plane{.name = "wall", .point = ends[end], .friction = wall.friction};
            plane.normal[a] = end == 0 ? 1 : -1;
            scene.planes.push_back(plane);
            wall = Wall::open;
            ++scene.grid.num_cells[a];
            if (end == 0) scene.grid.lower[a] -= scene.grid.spacing;
        }
    return scene;
}

template <int D>
void add_plane_friction(const Scene& scene, double wave_speed, Particles& particles,
                        Stages<D>& stages) {
    for (std::size_t k = 0; k < scene.planes.size(); ++k) {
        const std::size_t first = stages.fields.size();
        const bool has_friction = scene.planes[k].friction > 0;
        const RubbingPlane<D> plane(
            scene.planes[k], wave_speed, scene.grid.spacing,
            add_columns<D>("plane_" + std::to_string(k + 1), has_friction, particles, stages));
        stages.preparations.push_back([plane](Particles& points) { plane.start(points); });
        stages.forces.push_back(
            {"plane_friction", force_kernel<D>(Ground<D>(scene.planes[k]), first, has_friction)});
        stages.after_materials.push_back(
            {"plane_friction", [plane](Particles& points, const PointBlock<D>& block) {
                 plane.push(points, block);
             }});
    }
}

template void add_plane_friction<2>(const Scene&, double, Particles&, Stages<2>&);
template void add_plane_friction<3>(const Scene&, double, Particles&, Stages<3>&);

}  // namespace mpm
