#pragma once

#include "phase_log_mpi.hpp"
#include "progress.hpp"

#include <rrcb/controller.hpp>
#include <rrcb/experimental/cost.hpp>

#include <balancers_mpi.hpp>
#include <mpm/simulation.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace comparisons {

/// Run of a scene, the same for every method.
struct SimulationPlan {
    mpm::Scene scene;
    int num_steps = 1;
    int every = 1;           ///< steps between rebalances; 0: a controller says when
    int record_every = 1;    ///< steps between records of the load
    std::uint64_t seed = 1;  ///< of the order of turns
};

/// Points on every rank, after the rebalance of a step if it had one.
struct LoadRecord {
    std::int64_t step = 0;
    double time = 0;                ///< s
    std::vector<double> points;     ///< per part
    double moved_fraction = 0;      ///< of the points, by the latest rebalance; 0 before the first
    std::vector<double> seconds{};  ///< per part, of a step; mean since the record before
};

/// Cost of a whole simulation under one method; the same on every rank.
struct SimulationRun {
    std::string error;                  ///< empty unless the simulation failed
    std::optional<std::uint64_t> seed;  ///< of the method's points, where it varies with it
    std::int64_t num_points = 0;
    double wall_s = 0;           ///< balance_s + decide_s + step_s; records are not timed
    double balance_s = 0;        ///< rebalances with the migration of the points, slowest rank
    double decide_s = 0;         ///< the controller and learning costs, slowest rank
    double step_s = 0;           ///< steps, slowest rank
    double mean_imbalance = 1;   ///< over all steps, each after the rebalance it begins with
    double worst_imbalance = 1;  ///< of the same
    int rebalances = 0;
    double moved_fraction = 0;      ///< of the points that change owner, mean over the rebalances
    std::optional<double> front_m;  ///< largest x of a point that has moved a metre, at the end
    double moved_m = 0;             ///< the farthest that a point is from its start, at the end
    double mass_kg = 0;             ///< at the end; in 2-D per metre of depth
    double path_points = 0;         ///< most points on a rank, summed over the steps
    PathCost step_cost;
    PathCost balance_cost;
    PathCost decide_cost;
    std::vector<LoadRecord> history;
};

/// Seconds of the run with a core for every rank: the slowest rank of each step and rebalance, and
/// the network.
double critical_path_s(const SimulationRun& run);

/// Called before the first step and after every step.
using Observer = std::function<void(int steps_done, const mpm::Simulation&)>;

/// What a point weighs: one, or the seconds that it is learned to cost.
enum class Cost { count, learned };

/// Returns the balancer of a method, whose points have these weights; none for no rebalancing.
using BalancerMaker = std::function<std::optional<mpm::Balancer>(const PointWeights&)>;

/// A balancer that takes no weights, or none.
inline BalancerMaker without_weights(std::optional<mpm::Balancer> balancer) {
    return [balancer = std::move(balancer)](const PointWeights&) { return balancer; };
}

/// A scene under one method, to be run in turns with others so that all meet the same noise.
///
/// Rebalanced before step 0, every, 2 every, ... or when the controller says so, by processor time
/// outside MPI and network; without a balancer the slabs of the start stay.
/// All functions are collective over `comm`; a simulation that fails notes why and stands still.
/// The plan must outlive it.
class TimedSimulation {
  public:
    TimedSimulation(const SimulationPlan& plan, const BalancerMaker& make_balancer,
                    Observer observe, MPI_Comm comm, Cost cost = Cost::count);
    TimedSimulation(const TimedSimulation&) = delete;
    TimedSimulation& operator=(const TimedSimulation&) = delete;

    /// Advances by `num_steps`, at most to the end of the plan.
    void advance(int num_steps);

    /// What it has cost so far.
    SimulationRun result() const;

  private:
    void advance_one();
    void start_controller(Cost cost);
    void record_load();
    void record_step();
    std::vector<double> weights();
    bool is_due() const;
    void rebalance();
    void note_loads(SimulationRun& run) const;

    const SimulationPlan& plan_;
    std::optional<mpm::Balancer> balancer_;
    Observer observe_;
    MPI_Comm comm_;
    int num_ranks_ = 1;
    std::unique_ptr<mpm::Simulation> simulation_;
    std::optional<rrcb::Controller> controller_;
    std::optional<rrcb::experimental::CostModel> model_;
    SimulationRun run_;
    PhaseLog steps_;
    PhaseLog balances_;
    PhaseLog decisions_{Waits::in_the_next};  ///< the controller reduces during the next step
    std::vector<double> loads_;               ///< points on this rank in each step
    struct {
        double seconds = 0;
        double points = 0;
        std::vector<double> columns;
    } undecided_;              ///< sums over the steps that the controller does not know yet
    double moved_lately_ = 0;  ///< share of the points that the latest rebalance moved
    double seconds_since_record_ = 0;
    int steps_since_record_ = 0;
    int steps_done_ = 0;
};

/// Steps of the scene's time with the time step of its start. Collective over `comm`.
int steps_to_end(const mpm::Scene& scene, MPI_Comm comm);

}  // namespace comparisons
