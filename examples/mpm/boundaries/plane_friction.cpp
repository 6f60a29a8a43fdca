#include "boundaries/boundaries.hpp"
#include "particles/vectors.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

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

/// Columns of the points for one plane.
template <int D>
struct PlaneColumns {
    MotionColumns motion;
    std::array<Column, D> force{};   ///< in the next step, N; 0 where they do not touch
    std::array<Column, D> anchor{};  ///< of the spring along the plane, m
    Column damping = 0;              ///< part of the force out of the plane that a dashpot gives, N
    Column reach = 0;                ///< height above the plane below which they touch it, m
};

/// Consecutive points that are skipped together if all are far from the plane.
constexpr std::size_t seen_together = 32;

/// Columns that show whether points are at the plane, or were in the step before.
template <int D>
struct SeenPoints {
    SeenPoints(const Particles& particles, const PlaneColumns<D>& columns)
        : reach(particles[columns.reach].data()), damping(particles[columns.damping].data()) {
        for (std::size_t a = 0; a < D; ++a) {
            position[a] = particles[columns.motion.position[a]].data();
            force[a] = particles[columns.force[a]].data();
        }
    }

    std::array<const double*, D> position, force;
    const double *reach, *damping;
};

/// Whether any of some points is at the plane, or has forces of the step before.
template <int D>
MPM_VECTOR_CLONES bool touches_any(const SeenPoints<D>& points, const Ground<D>& ground,
                                   std::size_t begin, std::size_t end) {
    std::uint64_t any = 0;
    for (std::size_t p = begin; p < end; ++p) {
        Components<D> at;
        any |= std::bit_cast<std::uint64_t>(points.damping[p]);
        for (std::size_t a = 0; a < D; ++a) {
            at[a] = points.position[a][p];
            any |= std::bit_cast<std::uint64_t>(points.force[a][p]);
        }
        any |= points.reach[p] > ground.height(at) ? 1 : 0;
    }
    return any != 0;
}

/// A plane that meets points through a layer of springs and dashpots.
///
/// The nodes behind an inclined plane are no plane: they shake a body that slides across them,
/// which then sticks and slips by turns. So the plane meets the points. A dashpot with the
/// impedance of the body takes its vibrations (Lysmer and Kuhlemeyer 1969), a spring bears it, and
/// a spring along the plane holds it up to the friction (Cundall and Strack 1979).
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

    /// Points touch the plane when it is half their width away. Those that begin within their width
    /// touch it there, or a body on an inclined plane would fall until enough of its lowest points
    /// have come to the plane.
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
        double& damping = particles.data(columns_.damping)[p];
        damping = depth > 0 ? damping_of(particles, p, time_step) : 0;
        const double spring = depth > 0 ? spring_of(particles, p, depth) : 0;
        damping = std::max(damping, -spring);
        const double push = spring + damping;
        const Components<D> held =
            push > 0 ? friction_on(particles, p, at, push, time_step) : Components<D>{};
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

    /// Mass of a cell's height above the area that a point stands for, kg.
    double mass_above(const Particles& particles, std::size_t p) const {
        return particles[columns_.motion.mass][p] * spacing_ / width_of(particles, p);
    }

    /// Force of the spring out of the plane, N. The deeper, the stiffer: some tenths of a cell are
    /// the most.
    double spring_of(const Particles& particles, std::size_t p, double depth) const {
        constexpr double softness = 10;
        const double relative = softness * depth / spacing_;
        const double stiffness = rate_ * rate_ / softness * (1 + relative * relative);
        return mass_above(particles, p) * stiffness * depth;
    }

    /// Force of the dashpot out of the plane, N. In a step it takes no more than the velocity of
    /// half a cell of points, those that a node on the plane stands for.
    double damping_of(const Particles& particles, std::size_t p, double time_step) const {
        double across = 0;
        for (std::size_t a = 0; a < D; ++a)
            across += particles[columns_.motion.velocity[a]][p] * ground_.normal[a];
        return -mass_above(particles, p) * std::min(rate_, 0.5 / time_step) * across;
    }

    /// Force along the plane, N. Where the spring is at the friction, the anchor is dragged along.
    Components<D> friction_on(Particles& particles, std::size_t p, const Components<D>& at,
                              double push, double time_step) const {
        const double stiffness =
            std::min(mass_above(particles, p) * rate_ * rate_,
                     particles[columns_.motion.mass][p] / (time_step * time_step));
        if (!touched(particles, p))
            for (std::size_t a = 0; a < D; ++a) particles.data(columns_.anchor[a])[p] = at[a];
        Components<D> stretch;
        for (std::size_t a = 0; a < D; ++a) stretch[a] = at[a] - particles[columns_.anchor[a]][p];
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
            particles.data(columns_.anchor[a])[p] = at[a] - share * stretch[a];
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
    double rate_;  ///< of transits of a wave through a cell, 1/s
    PlaneColumns<D> columns_;
};

/// Adds the columns of a plane, and their sums on the nodes.
template <int D>
PlaneColumns<D> add_columns(const std::string& plane, Particles& particles, Stages<D>& stages) {
    PlaneColumns<D> columns{.motion = add_motion_columns(particles, D),
                            .damping = particles.add_column(plane + "_damping"),
                            .reach = particles.add_column(plane + "_reach")};
    for (std::size_t a = 0; a < D; ++a) {
        columns.force[a] = particles.add_column(plane + "_force_" + "xyz"[a]);
        columns.anchor[a] = particles.add_column(plane + "_anchor_" + "xyz"[a]);
        stages.fields.push_back({"plane_friction", columns.force[a], -1, static_cast<int>(a)});
    }
    stages.fields.push_back({"plane_friction", columns.damping});
    return columns;
}

/// Adds the forces of a plane to the nodes, whose fields begin at `first`.
///
/// Dashpots do no more in a step than stop a node: one that only few points touch has less mass
/// than those points stand for. Friction goes with the force out of the plane.
template <int D>
NodeKernel<D> force_kernel(const Ground<D>& ground, std::size_t first) {
    return [ground, first](GridPatch<D>& patch, const StepTime& now) {
        const std::vector<double>& damping = patch.fields[first + D];
        for (std::size_t n = 0; n < patch.sums.size(); ++n) {
            NodeSums<D>& node = patch.sums[n];
            Components<D> force;
            for (std::size_t a = 0; a < D; ++a) force[a] = patch.fields[first + a][n];
            const double push = along_normal<D>(ground.normal, force);
            if (!(push > 0)) continue;
            const double stop = -along_normal<D>(ground.normal, node.momentum) / now.time_step;
            const double left = std::clamp(damping[n], std::min(stop, 0.0), std::max(stop, 0.0));
            const double share = std::max(0.0, 1 - (damping[n] - left) / push);
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
        const RubbingPlane<D> plane(
            scene.planes[k], wave_speed, scene.grid.spacing,
            add_columns<D>("plane_" + std::to_string(k + 1), particles, stages));
        stages.preparations.push_back([plane](Particles& points) { plane.start(points); });
        stages.forces.push_back(
            {"plane_friction", force_kernel<D>(Ground<D>(scene.planes[k]), first)});
        stages.after_materials.push_back(
            {"plane_friction", [plane](Particles& points, const PointBlock<D>& block) {
                 plane.push(points, block);
             }});
    }
}

template void add_plane_friction<2>(const Scene&, double, Particles&, Stages<2>&);
template void add_plane_friction<3>(const Scene&, double, Particles&, Stages<3>&);

}  // namespace mpm
