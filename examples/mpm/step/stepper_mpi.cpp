#include "boundaries/boundaries.hpp"
#include "parallel/communicator_mpi.hpp"
#include "particles/vectors.hpp"
#include "step/stepper.hpp"
#include "transfer/scatter.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

/// Steps between sorts, within which points cross few cells.
constexpr int sort_interval = 50;
/// Share of the points, appended as they arrive, above which they are sorted at once.
constexpr double tolerated_disorder = 0.1;

MPI_Comm duplicate(MPI_Comm comm) {
    MPI_Comm own = MPI_COMM_NULL;
    MPI_Comm_dup(comm, &own);
    return own;
}

/// Stages of a scene but for the mirror images in walls. Walls and planes enter before effects.
template <int D>
Stages<D> build_stages(const Scene& scene, const Scene& ground, double wave_speed,
                       Particles& particles) {
    Stages<D> stages;
    add_walls<D>(ground, stages);
    add_plane_friction<D>(ground, wave_speed, particles, stages);
    for (const NamedEffect& effect : effects_of(scene)) {
        const EffectBuilder<D> builder{scene, effect.values, particles, stages, wave_speed};
        if constexpr (D == 2)
            effect.kind->build_2(builder);
        else
            effect.kind->build_3(builder);
    }
    return stages;
}

}  // namespace

template <int D>
Stepper<D>::Stepper(const Scene& scene, const ScenePoints& points, MPI_Comm comm)
    : Model(scene),
      scene_(scene),
      ground_(with_ground(scene)),
      comm_(duplicate(comm)),
      rule_(rule_for(scene)),
      transfers_(make_transfers<D>(scene_.shape_function, rule_.least_weight, particles)),
      fingerprint_(points.fingerprint),
      ownership_(ground_.grid, scene_.walls, comm_) {
    build_materials();
    stages_ = build_stages<D>(scene_, ground_, rule_.wave_speed, particles);
    add_images<D>(ground_, stages_);
    patch_.shape = ground_.grid;
    patch_.margin = transfers_->margin();
    patch_.fields.resize(stages_.fields.size());
    num_points = points.num_points;
    divide_by(slabs(points.box, size_of(comm_)), comm_);
    const auto place = [&] {
        place_points(scene_, decomposition, rank_of(comm_), motion_, particles);
        for (const auto& prepare : stages_.preparations) prepare(particles);
        transfers_->sort(particles, patch_);
    };
    in_memory(place, "bodies: the points", comm_);
    for (const double mass : particles[motion_.mass])
        lightest_point_ = std::min(lightest_point_, mass);
    MPI_Allreduce(MPI_IN_PLACE, &lightest_point_, 1, MPI_DOUBLE, MPI_MIN, comm_);
    max_speed = ownership_.agree(fastest_point()).max_speed;
    set_time_step();
}

template <int D>
void Stepper<D>::build_materials() {
    if (scene_.materials.size() > 1) material_column_ = particles.add_column("material");
    for (const Material& material : scene_.materials)
        materials_.push_back(build_material<D>(material, particles));
}

/// Divides space by a decomposition. The grid is kept while no box begins or ends in another cell.
/// Collective over `comm`, whose ranks fail together.
template <int D>
void Stepper<D>::divide_by(Decomposition next, MPI_Comm comm) {
    decomposition = std::move(next);
    decomposition.local_owners.clear();
    std::vector<NodeRange<D>> patches;
    patches.reserve(decomposition.boxes.size());
    for (const Box& box : decomposition.boxes)
        patches.push_back(nodes_of<D>(ground_.grid, box, patch_.margin));
    if (patches == patches_) return;
    patches_ = std::move(patches);
    const NodeRange<D>& mine = patches_[static_cast<std::size_t>(rank_of(comm_))];
    in_memory([&] { resize<D>(patch_, mine); }, "domain: the cells", comm);
    ghosts_.emplace(patches_, comm_);
}

/// Sums the fields of effects. Those with the same `where` follow one another.
template <int D>
void Stepper<D>::sum_fields() {
    int found = -1;  // the field that field_runs_ are for
    for (std::size_t f = 0; f < stages_.fields.size(); ++f) {
        const NodeField& field = stages_.fields[f];
        if (field.where >= 0 && field.where != found)
            find_runs_at<D>(patch_.fields[static_cast<std::size_t>(field.where)], ghosts_->shared(),
                            patch_, runs_, field_runs_);
        found = field.where;
        std::ranges::fill(patch_.fields[f], 0.0);
        transfers_->scatter(particles, field.column, field.axis,
                            field.where < 0 ? runs_ : field_runs_, patch_, patch_.fields[f]);
    }
}

template <int D>
void Stepper<D>::advance_nodes() {
    transfers_->find_runs(particles, patch_, runs_);
    transfers_->p2g(particles, runs_, stages_.volume_change, patch_);
    sum_fields();
    for (const auto& effect : stages_.scatters) effect.kernel(particles, runs_, patch_);
    work.pause();
    ghosts_->sum(patch_);
    work.resume();
    const StepTime now{time, time_step};
    for (const auto& effect : stages_.forces) effect.kernel(patch_, now);
    for (const auto& effect : stages_.constraints) effect.kernel(patch_, now);
    fastest_node_ = move_nodes(patch_, time_step, lightest_point_);
    for (const auto& effect : stages_.moved) effect.kernel(patch_, now);
}

template <int D>
void Stepper<D>::advance_points() {
    PointBlock<D> block{0, 0, 0, time, time_step, gradients_.get()};
    std::size_t run = 0;
    for (; block.begin < particles.size(); block.begin = block.end) {
        block.block_begin = block.begin;
        block.end = std::min(block.begin + block_size, particles.size());
        const std::size_t first_run = run;
        run = transfers_->g2p(particles, patch_, runs_, run, stages_.volume_change, block);
        for (const auto& effect : stages_.gradients)
            effect.kernel(particles, patch_, std::span(runs_).subspan(first_run, run - first_run),
                          block);
        apply_materials(block);
        for (const auto& effect : stages_.after_materials) effect.kernel(particles, block);
    }
}

template <int D>
void Stepper<D>::apply_materials(const PointBlock<D>& block) {
    if (!material_column_) {
        for (const auto& model : materials_.front().kernels) model.kernel(particles, block);
        return;
    }
    const std::span<const double> material = particles[*material_column_];
    PointBlock<D> part = block;
    // A part of the block ends at the next change of material.
    for (part.begin = block.begin; part.begin < block.end; part.begin = part.end) {
        const double number = material[part.begin];
        part.end = part.begin + 1;
        while (part.end < block.end && material[part.end] == number) ++part.end;
        for (const auto& model : materials_[static_cast<std::size_t>(number)].kernels)
            model.kernel(particles, part);
    }
}

template <int D>
double Stepper<D>::fastest_point() const {
    std::array<const double*, D> velocity;
    for (std::size_t a = 0; a < D; ++a) velocity[a] = particles[motion_.velocity[a]].data();
    Pair largest{};
    const auto take = [&](const std::array<Pair, D>& pair) {
        Pair square{};
        for (const Pair& component : pair) square += component * component;
        largest = square > largest ? square : largest;
    };
    std::array<Pair, D> pair;
    std::size_t p = 0;
    for (; p + 2 <= particles.size(); p += 2) {
        for (std::size_t a = 0; a < D; ++a) pair[a] = load_pair(velocity[a] + p);
        take(pair);
    }
    for (std::size_t a = 0; a < D; ++a) pair[a] = Pair{p < particles.size() ? velocity[a][p] : 0};
    take(pair);
    return std::sqrt(std::max(largest[0], largest[1]));
}

template <int D>
void Stepper<D>::set_time_step() {
    time_step = rule_.courant_number * scene_.grid.spacing / (rule_.wave_speed + max_speed);
    // The last step ends at the end.
    if (time < scene_.end_time) time_step = std::min(time_step, scene_.end_time - time);
}

/// Agrees with all ranks on the largest speed and sends the leavers. Collective.
template <int D>
void Stepper<D>::migrate_leavers(double speed) {
    const Agreement agreement = ownership_.agree(speed);
    max_speed = agreement.max_speed;
    const auto& owners = ownership_.leavers().owners;
    num_sent += std::ssize(owners) - std::ranges::count(owners, nobody);
    num_out_of_order_ +=
        migrate(particles, ownership_.leavers(), agreement.reach, ghosts_->neighbours(), comm_);
}

/// Sorts once so many points are out of order that they slow the transfers down.
template <int D>
void Stepper<D>::sort_if_needed() {
    const double tolerated = tolerated_disorder * static_cast<double>(particles.size());
    if (steps_since_sort_ < sort_interval && static_cast<double>(num_out_of_order_) <= tolerated)
        return;
    transfers_->sort(particles, patch_);
    num_out_of_order_ = 0;
    steps_since_sort_ = 0;
}

template <int D>
void Stepper<D>::step() {
    work.restart();
    advance_nodes();
    advance_points();
    work.pause();
    worked_points = static_cast<double>(particles.size());
    for (const auto& effect : stages_.ends) effect.kernel({time, time_step}, comm_);
    time += time_step;
    ++num_steps;
    ++steps_since_sort_;
    ownership_.find_leavers<D>(decomposition, particles, motion_, time, ghosts_->neighbours());
    migrate_leavers(std::max(fastest_point(), fastest_node_));
    sort_if_needed();
    set_time_step();
}

template <int D>
std::size_t Stepper<D>::rebalance(const Balancer& balancer) {
    Decomposition next = balancer(positions(), comm_);
    ownership_.find_reassigned(next, positions(), ghosts_->neighbours());
    migrate_leavers(max_speed);
    divide_by(std::move(next), comm_);
    sort_if_needed();
    return ownership_.leavers().points.size();
}

template <int D>
std::vector<double> Stepper<D>::work_columns() const {
    return {worked_points, static_cast<double>(runs_.size()),
            static_cast<double>(patch_.sums.size()), static_cast<double>(ghosts_->num_shared())};
}

template <int D>
std::vector<double> Stepper<D>::point_columns() const {
    std::vector<CellRun<D>> runs;
    transfers_->find_runs(particles, patch_, runs);
    return mpm::point_columns<D>(patch_, runs);
}

template class Stepper<2>;
template class Stepper<3>;

}  // namespace mpm
