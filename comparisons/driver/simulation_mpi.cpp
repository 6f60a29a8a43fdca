#include "simulation_mpi.hpp"

#include "failure_mpi.hpp"
#include "statistics.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <span>

/// A step whose columns are recorded, under a name by which Callgrind finds it.
extern "C" __attribute__((noinline)) void rrcb_recorded_step(mpm::Simulation& simulation) {
    simulation.step();
}

namespace comparisons {

namespace {

constexpr double nowhere = -std::numeric_limits<double>::infinity();

/// The controller gets sums over this number of steps, because the steps of the scenes are short.
constexpr int steps_a_decision = 4;

/// Returns the seconds that `action` takes on this rank. All ranks start together.
template <typename Action>
double timed(Action&& action, PhaseLog& log, MPI_Comm comm) {
    MPI_Barrier(comm);
    const double start = MPI_Wtime();
    log.record(action);
    return MPI_Wtime() - start;
}

/// Returns the value of each rank.
std::vector<double> gathered(double mine, MPI_Comm comm) {
    std::vector<double> all(static_cast<std::size_t>(size_of(comm)));
    MPI_Allgather(&mine, 1, MPI_DOUBLE, all.data(), 1, MPI_DOUBLE, comm);
    return all;
}

/// Runs `action` unless an earlier one has failed. Records a failure, which is the same on all
/// ranks.
template <typename Action>
void unless_failed(SimulationRun& run, Action&& action) {
    if (!run.error.empty()) return;
    try {
        action();
    } catch (const std::runtime_error& error) {
        run.error = error.what();
    }
}

void note_state(SimulationRun& run, const mpm::Simulation& simulation, MPI_Comm comm) {
    const mpm::Particles& particles = simulation.particles();
    const auto x = particles["x"];
    const auto mass = particles["mass"];
    const std::vector<mpm::Vector> ways = simulation.displacements();
    double front = nowhere;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        run.mass_kg += mass[i];
        const double moved = std::hypot(ways[i][0], ways[i][1], ways[i][2]);
        run.moved_m = std::max(run.moved_m, moved);
        if (moved > 1) front = std::max(front, x[i]);
    }
    for (double* most : {&front, &run.moved_m, &run.balance_s, &run.step_s, &run.decide_s})
        MPI_Allreduce(MPI_IN_PLACE, most, 1, MPI_DOUBLE, MPI_MAX, comm);
    MPI_Allreduce(MPI_IN_PLACE, &run.mass_kg, 1, MPI_DOUBLE, MPI_SUM, comm);
    if (front > nowhere) run.front_m = front;
    run.wall_s = run.balance_s + run.decide_s + run.step_s;
}

/// Sums the work of the ranks in their steps. Collective over `comm`.
StepWork step_work(std::span<const double> of_steps, MPI_Comm comm) {
    StepWork work{sum(of_steps), sum(largest_of_ranks({of_steps.begin(), of_steps.end()}, comm))};
    MPI_Allreduce(MPI_IN_PLACE, &work.all, 1, MPI_DOUBLE, MPI_SUM, comm);
    return work;
}

/// Returns the first twentieth of the steps, in which the points of the slope are at rest.
std::span<const double> at_rest(std::span<const double> of_steps) {
    return of_steps.first(of_steps.size() / 20);
}

}  // namespace

double critical_path_s(const SimulationRun& run) {
    double sum = 0;
    for (const PathCost* cost : {&run.step_cost, &run.balance_cost, &run.decide_cost})
        sum += cost->path_s + cost->network_s;
    return sum;
}

TimedSimulation::TimedSimulation(const SimulationPlan& plan, const BalancerMaker& make_balancer,
                                 Observer observe, MPI_Comm comm, Cost cost,
                                 const SimulationRun* repeated)
    : plan_(plan), observe_(std::move(observe)), comm_(comm), cost_(cost), repeated_(repeated) {
    MPI_Comm_size(comm, &num_ranks_);
    balancer_ = make_balancer(cost == Cost::count ? PointWeights()
                                                  : PointWeights([this] { return weights(); }));
    unless_failed(run_, [&] {
        simulation_ = plan.state.empty()
                          ? std::make_unique<mpm::Simulation>(plan.scene, comm)
                          : std::make_unique<mpm::Simulation>(plan.scene, plan.state, comm);
        if (balancer_) start_controller();
        run_.num_points = simulation_->num_points();
        if (observe_) observe_(0, *simulation_);
    });
}

void TimedSimulation::start_controller() {
    if (plan_.every == 0) controller_.emplace(comm_);
    if (cost_ != Cost::learned) return;
    const auto num_columns = static_cast<int>(simulation_->work_columns().size());
    if (controller_)
        model_.emplace(*controller_, num_columns);
    else
        model_.emplace(comm_, num_columns);
}

/// Of a unit of each column in this rebalance; empty: points are counted.
std::vector<double> TimedSimulation::costs() const {
    if (repeated_) return repeated_->plan.at(run_.plan.size()).costs;
    if (cost_ == Cost::known) return plan_.unit_costs;
    return model_ && model_->uses_costs() ? model_->costs() : std::vector<double>();
}

std::vector<double> TimedSimulation::weights() {
    if (model_) model_->weights({});  // its guard asks which weights were in use
    const std::vector<double> of_unit = costs();
    if (of_unit.empty()) return {};
    const std::vector<double> rows = simulation_->point_columns();
    std::vector<double> weights(rows.size() / of_unit.size());
    for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] = std::inner_product(of_unit.begin(), of_unit.end(),
                                        rows.data() + i * of_unit.size(), 0.0);
    return weights;
}

void TimedSimulation::advance(int num_steps) {
    const int end = std::min(plan_.num_steps, steps_done_ + num_steps);
    unless_failed(run_, [&] {
        while (steps_done_ < end) advance_one();
    });
}

void TimedSimulation::advance_one() {
    if (balancer_ && is_due()) rebalance();
    const bool is_recorded = steps_done_ % plan_.record_every == 0;
    if (is_recorded) record_load();
    loads_.push_back(static_cast<double>(simulation_->positions().x.size()));
    const auto step = [&] { is_recorded ? rrcb_recorded_step(*simulation_) : simulation_->step(); };
    run_.step_s += timed(step, steps_, comm_);
    record_step(is_recorded);
    ++steps_done_;
    if (observe_) observe_(steps_done_, *simulation_);
}

void TimedSimulation::record_load() {
    const auto count = static_cast<double>(simulation_->positions().x.size());
    run_.history.push_back(
        {simulation_->step_count(), simulation_->time(), gathered(count, comm_), moved_lately_});
}

/// Records the step that has just been done.
void TimedSimulation::record_step(bool is_recorded) {
    const std::vector<double> columns = simulation_->work_columns();
    counted_.push_back(
        std::inner_product(columns.begin(), columns.end(), plan_.unit_costs.begin(), 0.0));
    if (is_recorded) {
        std::vector<std::vector<double>>& all = run_.history.back().columns;
        for (const double column : columns) all.push_back(gathered(column, comm_));
        all.push_back(gathered(counted_.back(), comm_));
    }
    if (!model_ && !controller_) return;
    undecided_.seconds += steps_.last_s(num_ranks_);
    undecided_.points += loads_.back();
    if (model_) {
        undecided_.columns.resize(columns.size());
        std::ranges::transform(undecided_.columns, columns, undecided_.columns.begin(),
                               std::plus());
    }
    if ((steps_done_ + 1) % steps_a_decision != 0) return;
    const auto decide = [&] {
        if (model_)
            model_->step(undecided_.seconds, undecided_.columns);
        else
            controller_->step({.load = undecided_.seconds, .weight = undecided_.points});
    };
    run_.decide_s += timed(decide, decisions_, comm_);
    undecided_ = {};
}

bool TimedSimulation::is_due() const {
    if (repeated_) {
        const std::size_t number = run_.plan.size();
        return number < repeated_->plan.size() && repeated_->plan[number].step == steps_done_;
    }
    if (!controller_) return steps_done_ % plan_.every == 0;
    return steps_done_ == 0 || controller_->due();
}

void TimedSimulation::rebalance() {
    std::uint64_t moved = 0;
    run_.balance_s += timed([&] { moved = simulation_->rebalance(*balancer_); }, balances_, comm_);
    run_.plan.push_back({steps_done_, costs()});
    MPI_Allreduce(MPI_IN_PLACE, &moved, 1, MPI_UINT64_T, MPI_SUM, comm_);
    if (controller_) controller_->rebalanced({.cost = balances_.last_s(num_ranks_)});
    const auto num_points = static_cast<double>(std::max<std::int64_t>(1, run_.num_points));
    moved_lately_ = static_cast<double>(moved) / num_points;
    run_.moved_fraction += (moved_lately_ - run_.moved_fraction) / ++run_.rebalances;
}

/// The number of points is constant, so the mean load is the same in every step.
void TimedSimulation::note_loads(SimulationRun& run) const {
    const std::vector<double> most = largest_of_ranks(loads_, comm_);
    run.path_points = sum(most);
    if (run.path_points == 0) return;
    const double mean = static_cast<double>(run.num_points) / num_ranks_;
    run.mean_imbalance = run.path_points / static_cast<double>(most.size()) / mean;
    run.worst_imbalance = *std::ranges::max_element(most) / mean;
}

SimulationRun TimedSimulation::result() const {
    SimulationRun run = run_;
    unless_failed(run, [&] {
        note_state(run, *simulation_, comm_);
        note_loads(run);
        run.step_cost = steps_.cost(comm_);
        run.work_s = steps_.work_s();
        if (repeated_)
            std::ranges::transform(run.work_s, repeated_->work_s, run.work_s.begin(),
                                   [](double one, double other) { return std::min(one, other); });
        run.counted = step_work(counted_, comm_);
        run.counted_at_rest = step_work(at_rest(counted_), comm_);
        run.least_s = step_work(run.work_s, comm_);
        run.least_at_rest_s = step_work(at_rest(run.work_s), comm_);
        run.balance_cost = balances_.cost(comm_);
        run.decide_cost = decisions_.cost(comm_);
    });
    return run;
}

int steps_to_end(const mpm::Scene& scene, MPI_Comm comm) {
    const mpm::Simulation simulation(scene, comm);
    return std::max(1, static_cast<int>(std::ceil(scene.end_time / simulation.time_step())));
}

}  // namespace comparisons
