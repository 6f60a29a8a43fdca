#include "boundaries/boundaries.hpp"
#include "parallel/communicator_mpi.hpp"
#include "parallel/points.hpp"
#include "particles/vectors.hpp"
#include "step/stepper.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

/// Points are sorted again when the number of runs has grown by this factor since the last sort. A
/// run costs as much as four points.
constexpr double tolerated_runs = 1.2;
/// The number of cells that points may move before the patch is fitted to them again.
constexpr double slack = 1;

/// Returns the smallest and the largest of some numbers. Compares two at a time.
std::array<double, 2> extent_of(std::span<const double> numbers) {
    Pair least{numbers.front(), numbers.back()}, most = least;
    for (std::size_t p = 0; p + 2 <= numbers.size(); p += 2) {
        const Pair here = load_pair(numbers.data() + p);
        least = here < least ? here : least;
        most = here > most ? here : most;
    }
    return {std::min(least[0], least[1]), std::max(most[0], most[1])};
}

/// Returns the stages of a scene without the mirror images in walls. Walls and planes come before
/// effects.
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
    : Model(scene, comm),
      scene_(scene),
      ground_(with_ground(scene)),
      rule_(rule_for(scene)),
      transfers_(make_transfers<D>(scene_.shape_function, rule_.least_weight, particles)),
      fingerprint_(points.fingerprint),
      strays_(ground_.grid, scene_.walls) {
    build_materials();
    stages_ = build_stages<D>(scene_, ground_, rule_.wave_speed, particles);
    add_images<D>(ground_, stages_);
    patch_.shape = ground_.grid;
    patch_.margin = transfers_->margin();
    patch_.fields.resize(stages_.fields.size());
    num_points = points.num_points;
    // Nodes of a box reach one cell and the margin beyond it.
    travel_.travel = 2 * (1 + patch_.margin) * ground_.grid.spacing;
    divide_by(slabs(points.box, size_of(comm_)));
    neighbours_.emplace(boxes_of(decomposition), D, comm_, travel_);
    const auto place = [&] {
        place_points(scene_, decomposition, rank_of(comm_), motion_, particles);
        for (const auto& prepare : stages_.preparations) prepare(particles);
    };
    together(place, "bodies: the points", comm_);
    together([&] { fit_patch(); }, "domain: the cells", comm_);
    together([&] { sort(); }, "bodies: the points", comm_);
    for (const double mass : particles[motion_.mass])
        lightest_point_ = std::min(lightest_point_, mass);
    MPI_Allreduce(MPI_IN_PLACE, &lightest_point_, 1, MPI_DOUBLE, MPI_MIN, comm_);
    max_speed = start_speed_ = speed_ = speed_of_all(fastest_point());
    set_time_step();
}

template <int D>
void Stepper<D>::build_materials() {
    if (scene_.materials.size() > 1) material_column_ = particles.add_column("material");
    for (const Material& material : scene_.materials)
        materials_.push_back(build_material<D>(material, particles));
}

/// Returns the owners of this rank's points. Collective: throws std::runtime_error on all ranks if
/// some rank does not get them.
template <int D>
std::vector<int> Stepper<D>::owners_by(const Decomposition& next) const {
    std::vector<int> owners = next.local_owners;
    std::string fault;
    try {
        if (owners.empty()) {
            owners.resize(particles.size(), -1);
            next.owners(positions(), owners);
        }
        const auto num_ranks = static_cast<std::size_t>(size_of(comm_));
        if (owners.size() != particles.size() || next.boxes.size() != num_ranks ||
            std::ranges::any_of(
                owners, [&](int owner) { return static_cast<std::size_t>(owner) >= num_ranks; }))
            throw std::runtime_error("");
    } catch (const std::exception&) {
        fault =
            "the decomposition named no owner of some point: it must give one box per rank and a "
            "rank for every position in the grid";
    }
    fail_together(fault, comm_);
    return owners;
}

/// Adopts a decomposition. Not collective: find the neighbours and fit the patch afterwards.
template <int D>
void Stepper<D>::divide_by(Decomposition next) {
    decomposition = std::move(next);
    decomposition.local_owners.clear();
    std::vector<NodeRange<D>> ranges;
    ranges.reserve(decomposition.boxes.size());
    for (const Box& box : decomposition.boxes)
        ranges.push_back(nodes_of<D>(ground_.grid, box, patch_.margin));
    ghosts_.emplace(ranges, rank_of(comm_));
    ghosts_->number(patch_);
}

/// Fits the patch to the extent of this rank's points plus `slack`, clipped to the rank's box.
template <int D>
void Stepper<D>::fit_patch() {
    const Box& box = decomposition.boxes[static_cast<std::size_t>(rank_of(comm_))];
    const Vector upper = ground_.grid.upper();
    const double way = slack * ground_.grid.spacing;
    home_ = particles.size() > 0 ? Box{} : Box{upper, ground_.grid.lower};
    for (std::size_t a = 0; a < D && particles.size() > 0; ++a) {
        const auto [least, most] = extent_of(particles[motion_.position[a]]);
        home_.lower[a] = std::max({least - way, box.lower[a], ground_.grid.lower[a]});
        home_.upper[a] = std::min({most + way, box.upper[a], upper[a]});
    }
    const NodeRange<D> nodes = nodes_of<D>(ground_.grid, home_, patch_.margin);
    if (nodes == patch_.nodes) return;
    resize<D>(patch_, nodes);
    ghosts_->number(patch_);
}

/// Fits the patch to the points after a rebalance. Collective.
template <int D>
void Stepper<D>::fit_to_box(std::size_t num_new) {
    const Box& box = decomposition.boxes[static_cast<std::size_t>(rank_of(comm_))];
    const auto fit = [&] {
        if (!are_inside<D>(box, particles, motion_))
            throw std::runtime_error(
                "the decomposition gave a point to a rank whose box does not hold it");
        fit_patch();
    };
    together(fit, "domain: the cells", comm_);
    sort_if_needed(num_new);
}

/// Fits the patch to the points after a step if some of them have got to where it has no nodes.
template <int D>
void Stepper<D>::fit_to_points(std::size_t num_new) {
    if (has_outgrown_ || (num_new > 0 && !are_inside<D>(home_, particles, motion_))) fit_patch();
    sort_if_needed(num_new);
}

template <int D>
void Stepper<D>::points_to_nodes() {
    transfers_->find_runs(particles, patch_, runs_);
    if (num_sorted_runs_ == 0) num_sorted_runs_ = runs_.size();
    transfers_->p2g(particles, runs_, stages_.volume_change, patch_);
    for (std::size_t f = 0; f < stages_.fields.size(); ++f) {
        std::ranges::fill(patch_.fields[f], 0.0);
        transfers_->scatter(particles, stages_.fields[f].column, runs_, patch_, patch_.fields[f]);
    }
    for (const auto& effect : stages_.scatters) effect.kernel(particles, runs_, patch_);
}

template <int D>
void Stepper<D>::move_nodes() {
    const StepTime now{time, time_step};
    for (const auto& effect : stages_.forces) effect.kernel(patch_, now);
    for (const auto& effect : stages_.constraints) effect.kernel(patch_, now);
    fastest_node_ = mpm::move_nodes(patch_, time_step, lightest_point_);
    for (const auto& effect : stages_.moved) effect.kernel(patch_, now);
}

template <int D>
void Stepper<D>::nodes_to_points() {
    worked_points = static_cast<double>(particles.size());
    PointBlock<D> block{0, 0, 0, time, time_step, gradients_.get()};
    std::size_t run = 0;
    for (; block.begin < particles.size(); block.begin = block.end) {
        block.block_begin = block.begin;
        block.end = std::min(block.begin + block_size, particles.size());
        run = transfers_->g2p(particles, patch_, runs_, run, stages_.volume_change, block);
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
    // A part of the block ends where the material changes.
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

/// Speed of the fastest point or node of this rank in this step.
template <int D>
double Stepper<D>::fastest() {
    return speed_ = std::max(fastest_point(), fastest_node_);
}

template <int D>
double Stepper<D>::speed_of_all(double mine) const {
    MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_DOUBLE, MPI_MAX, comm_);
    return mine;
}

template <int D>
void Stepper<D>::set_time_step() {
    time_step = rule_.courant_number * scene_.grid.spacing / (rule_.wave_speed + max_speed);
    // The last step is shortened so that it ends at end_time.
    if (time < scene_.end_time) time_step = std::min(time_step, scene_.end_time - time);
}

/// Ends a step. The next time step is computed from the largest speed in the step before this one.
template <int D>
void Stepper<D>::end_step(double speed_before) {
    std::string fault;
    try {
        has_outgrown_ = strays_.remove<D>(home_, motion_, time + time_step, particles);
    } catch (const std::runtime_error& error) {
        fault = error.what();
    }
    // An effect that reduces its sums must find all ranks.
    if (!stages_.ends.empty()) fail_together(fault, comm_);
    if (!fault.empty()) neighbours_->fail(fault);
    for (const auto& effect : stages_.ends) effect.kernel({time, time_step}, comm_);
    time += time_step;
    ++num_steps;
    max_speed = speed_before < 0 ? start_speed_ : speed_before;
    set_time_step();
}

template <int D>
void Stepper<D>::sort() {
    transfers_->sort(particles, patch_);
    num_sorted_runs_ = 0;
}

/// Sorts the points if they have so many more runs than after the last sort that these slow the
/// transfers down. Each point that has arrived counts as a run.
template <int D>
void Stepper<D>::sort_if_needed(std::size_t num_arrived) {
    if (num_sorted_runs_ == 0 && num_arrived == 0) return;
    const auto runs = static_cast<double>(runs_.size() + num_arrived);
    if (runs <= tolerated_runs * static_cast<double>(num_sorted_runs_)) return;
    fit_patch();
    sort();
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
