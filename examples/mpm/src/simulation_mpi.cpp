#include <mpm/effects.hpp>
#include <mpm/ghost_nodes_mpi.hpp>
#include <mpm/grid.hpp>
#include <mpm/lattice.hpp>
#include <mpm/migration_mpi.hpp>
#include <mpm/ownership_mpi.hpp>
#include <mpm/simulation.hpp>
#include <mpm/transfer.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace mpm {

namespace {

/// Steps between sorts, within which points cross few cells.
constexpr int sort_interval = 50;
/// Arrivals are appended; when this share of the points is out of order it is sorted at once.
constexpr double tolerated_disorder = 0.1;
/// Share of a full cell's mass below which a node's acceleration strains points less.
constexpr double least_mass_fraction = 0.01;

MPI_Comm duplicate(MPI_Comm comm) {
    MPI_Comm own = MPI_COMM_NULL;
    MPI_Comm_dup(comm, &own);
    return own;
}

int rank_of(MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return rank;
}

int size_of(MPI_Comm comm) {
    int size = 1;
    MPI_Comm_size(comm, &size);
    return size;
}

double max_over_bodies(const Scene& scene, double (*value)(const Scene&, const Body&)) {
    double largest = 0;
    for (const Body& body : scene.bodies) largest = std::max(largest, value(scene, body));
    return largest;
}

double wave_speed(const Scene& scene, const Body& body) {
    return scene.elastic.wave_speed(body.density);
}

double full_cell_mass(const Scene& scene, const Body& body) {
    return body.density * scene.grid.spacing * scene.grid.spacing;
}

}  // namespace

struct Simulation::State {
    State(const Scene& scene, const Extent& extent, MPI_Comm comm);
    ~State() { MPI_Comm_free(&comm); }

    Positions positions() const { return {particles[motion.x], particles[motion.y]}; }
    void adopt(Decomposition next);
    void gather_on_nodes();
    void advance_points();
    double fastest_point() const;
    void set_time_step(double fastest);
    void take_in(std::size_t num_arrived);

    Scene scene;
    MPI_Comm comm;
    Particles particles;
    MotionColumns motion = add_motion_columns(particles);
    StressColumns stress = add_stress_columns(particles);
    Effects effects;
    double wave_speed = 0, least_mass = 0;

    Decomposition decomposition;
    Ownership ownership;
    GridPatch patch;
    std::optional<GhostNodes> ghosts;
    std::vector<CellRun> runs;
    PointBlock block{};
    std::size_t num_out_of_order = 0;
    int steps_since_sort = 0;

    std::int64_t num_points = 0, num_steps = 0;
    double time = 0, time_step = 0, max_speed = 0;
};

Simulation::State::State(const Scene& the_scene, const Extent& extent, MPI_Comm user_comm)
    : scene(the_scene),
      comm(duplicate(user_comm)),
      effects(build_effects(scene, particles)),
      wave_speed(max_over_bodies(scene, mpm::wave_speed)),
      least_mass(least_mass_fraction * max_over_bodies(scene, full_cell_mass)),
      ownership(scene.grid, comm) {
    patch.shape = scene.grid;
    num_points = extent.num_points;
    adopt(slabs(extent.box, size_of(comm)));
    place_points(scene, decomposition, rank_of(comm), motion, particles);
    sort_by_cell(particles, motion, patch);
    set_time_step(ownership.agree(fastest_point()).max_speed);
}

/// Lays the patches of all ranks by the boxes of a decomposition.
void Simulation::State::adopt(Decomposition next) {
    decomposition = std::move(next);
    decomposition.local_owners.clear();
    std::vector<NodeRange> patches;
    for (const Box& box : decomposition.boxes) patches.push_back(nodes_of(scene.grid, box));
    resize(patch, patches[static_cast<std::size_t>(rank_of(comm))]);
    ghosts.emplace(patches, comm);
}

void Simulation::State::gather_on_nodes() {
    find_cell_runs(particles, motion, patch, runs);
    p2g(particles, motion, stress, runs, patch);
    ghosts->sum(patch);
    for (const auto& effect : effects.nodes) effect.kernel(patch, time);
    move_nodes(patch, time_step, least_mass);
}

void Simulation::State::advance_points() {
    block.time_step = time_step;
    std::size_t next_run = 0;
    for (block.begin = 0; block.begin < particles.size(); block.begin = block.end) {
        block.end = std::min(block.begin + block_size, particles.size());
        next_run = g2p(particles, motion, patch, runs, next_run, scene.flip_fraction, block);
        for (const auto& effect : effects.points) effect.kernel(particles, block);
    }
}

double Simulation::State::fastest_point() const {
    const std::span<const double> x = particles[motion.velocity_x];
    const std::span<const double> y = particles[motion.velocity_y];
    double largest = 0;
    for (std::size_t p = 0; p < x.size(); ++p)
        largest = std::max(largest, x[p] * x[p] + y[p] * y[p]);
    return std::sqrt(largest);
}

void Simulation::State::set_time_step(double fastest) {
    max_speed = fastest;
    time_step = scene.courant_number * scene.grid.spacing / (wave_speed + max_speed);
}

/// Sorts when enough points are out of order to slow the transfers down.
void Simulation::State::take_in(std::size_t num_arrived) {
    num_out_of_order += num_arrived;
    const double tolerated = tolerated_disorder * static_cast<double>(particles.size());
    if (steps_since_sort < sort_interval && static_cast<double>(num_out_of_order) <= tolerated)
        return;
    sort_by_cell(particles, motion, patch);
    num_out_of_order = 0;
    steps_since_sort = 0;
}

Simulation::Simulation(const Scene& scene, MPI_Comm comm) {
    validate(scene);
    const Extent extent = extent_of(scene);
    if (extent.num_points == 0)
        throw std::invalid_argument("scene: no body holds a point of the grid's lattice");
    state_ = std::make_unique<State>(scene, extent, comm);
}

Simulation::~Simulation() = default;

void Simulation::step() {
    State& s = *state_;
    s.gather_on_nodes();
    s.advance_points();
    s.time += s.time_step;
    ++s.num_steps;
    ++s.steps_since_sort;

    s.ownership.find_leavers(s.decomposition, s.positions(), s.ghosts->neighbours());
    const Agreement agreement = s.ownership.agree(s.fastest_point());
    s.take_in(migrate(s.particles, s.ownership.leavers(), agreement.reach, s.ghosts->neighbours(),
                      s.comm));
    s.set_time_step(agreement.max_speed);
}

RebalanceReport Simulation::rebalance(const Balancer& balancer) {
    State& s = *state_;
    Decomposition next = balancer(s.positions(), s.comm);
    s.ownership.find_reassigned(next, s.positions());
    const Agreement agreement = s.ownership.agree(0);

    RebalanceReport report;
    report.moved_points = static_cast<std::int64_t>(s.ownership.leavers().points.size());
    MPI_Allreduce(MPI_IN_PLACE, &report.moved_points, 1, MPI_INT64_T, MPI_SUM, s.comm);
    s.adopt(std::move(next));
    s.take_in(migrate(s.particles, s.ownership.leavers(), agreement.reach, {}, s.comm));
    return report;
}

double Simulation::time() const {
    return state_->time;
}
double Simulation::time_step() const {
    return state_->time_step;
}
std::int64_t Simulation::step_count() const {
    return state_->num_steps;
}
std::int64_t Simulation::num_points() const {
    return state_->num_points;
}
double Simulation::max_speed() const {
    return state_->max_speed;
}
const Particles& Simulation::particles() const {
    return state_->particles;
}
Positions Simulation::positions() const {
    return state_->positions();
}
const Decomposition& Simulation::decomposition() const {
    return state_->decomposition;
}

std::vector<std::string> Simulation::kernels() const {
    std::vector<std::string> names{"p2g", "ghost_nodes"};
    for (const auto& effect : state_->effects.nodes) names.push_back(effect.name);
    names.insert(names.end(), {"move_nodes", "g2p"});
    for (const auto& effect : state_->effects.points) names.push_back(effect.name);
    names.push_back("migrate");
    return names;
}

}  // namespace mpm
