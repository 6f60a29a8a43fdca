#pragma once

#include "phase_log_mpi.hpp"

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

/// The settings with which a scene is run with every method.
struct SimulationPlan {
    mpm::Scene scene;
    int num_steps = 1;
    int every = 1;           ///< steps between rebalances; 0: a controller decides
    int record_every = 1;    ///< steps between records of the load
    std::uint64_t seed = 1;  ///< for the order of turns
    std::string state{};     ///< file of the first state; empty: the start of the scene
    bool progress = false;   ///< show on standard error how much is done
    /// Instructions of a step for a unit of each of mpm::Simulation::work_columns().
    std::vector<double> unit_costs = {1, 0, 0, 0};
};

/// The number of points on every rank in a step, after its rebalance if it had one.
struct LoadRecord {
    std::int64_t step = 0;
    double time = 0;             ///< s
    std::vector<double> points;  ///< per part
    double moved_fraction = 0;   ///< share of the points moved by the last rebalance; 0 before the
                                 ///< first
    /// Each of mpm::Simulation::work_columns(), and then the instructions, per part.
    std::vector<std::vector<double>> columns{};
};

/// A rebalance of a run, which another run can repeat.
struct Rebalance {
    int step = 0;
    std::vector<double> costs;  ///< weight of a unit of each column; empty: each point weighs 1
};

/// Work in the steps of a run.
struct StepWork {
    double all = 0;   ///< of all ranks
    double path = 0;  ///< of the busiest rank of each step
};

/// The cost of a complete simulation with one method. It is the same on every rank.
struct SimulationRun {
    std::string error;                  ///< empty unless the simulation failed
    std::optional<std::uint64_t> seed;  ///< seed of the method's points, if it varies with the seed
    std::int64_t num_points = 0;
    double wall_s = 0;           ///< balance_s + decide_s + step_s, without the time of records
    double balance_s = 0;        ///< rebalances including migration, on the slowest rank
    double decide_s = 0;         ///< controller and learning of costs, on the slowest rank
    double step_s = 0;           ///< steps, on the slowest rank
    double mean_imbalance = 1;   ///< mean over all steps, after the rebalance of the step
    double worst_imbalance = 1;  ///< largest value of any step
    int rebalances = 0;
    double moved_fraction = 0;  ///< share of the points that change owner, mean over the rebalances
    std::optional<double> front_m;  ///< largest x of a point that has moved a metre, at the end
    double moved_m = 0;      ///< largest distance of a point from its start position, at the end
    double mass_kg = 0;      ///< at the end; in 2-D per metre of depth
    double path_points = 0;  ///< largest number of points on a rank, summed over the steps
    PathCost step_cost;
    PathCost balance_cost;
    PathCost decide_cost;
    std::vector<LoadRecord> history;
    std::vector<Rebalance> plan;  ///< when it was rebalanced
    std::vector<double> work_s;   ///< of this rank in each step
    StepWork counted;             ///< instructions, by unit costs
    StepWork counted_at_rest;     ///< in the first twentieth of the steps
    StepWork least_s;             ///< of each rank and step the least of all equal runs
    StepWork least_at_rest_s;
};

/// Returns the seconds of the run if every rank has a core of its own: the time of the slowest rank
/// in each step and rebalance, plus the time of the network.
double critical_path_s(const SimulationRun& run);

/// Called before the first step and after every step, unless it is empty.
using Observer = std::function<void(int steps_done, const mpm::Simulation&)>;

/// The weight of a point: one, the seconds that the point is estimated to take, or its instructions
/// by the unit costs of the plan.
enum class Cost { count, learned, known };

/// Returns the balancer of a method for points with these weights, or nullopt for no rebalancing.
using BalancerMaker = std::function<std::optional<mpm::Balancer>(const PointWeights&)>;

/// Returns a BalancerMaker for a balancer that ignores weights.
inline BalancerMaker without_weights(std::optional<mpm::Balancer> balancer) {
    return [balancer = std::move(balancer)](const PointWeights&) { return balancer; };
}

/// Runs a scene with one method. Several such simulations are advanced in turn, so that noise
/// affects all of them equally.
///
/// The points are rebalanced before the steps 0, every, 2 every, ... or when the controller
/// decides, based on the processor time outside MPI and the estimated time of the network. Without
/// a balancer the initial slabs are kept. All functions are collective over `comm`. A simulation
/// that fails records the reason and does not advance further. The plan must outlive the object.
class TimedSimulation {
  public:
    /// With `repeated`, which must outlive it, it is rebalanced as in that run.
    TimedSimulation(const SimulationPlan& plan, const BalancerMaker& make_balancer,
                    Observer observe, MPI_Comm comm, Cost cost = Cost::count,
                    const SimulationRun* repeated = nullptr);
    TimedSimulation(const TimedSimulation&) = delete;
    TimedSimulation& operator=(const TimedSimulation&) = delete;

    /// Advances by `num_steps` steps, but not beyond the end of the plan.
    void advance(int num_steps);

    /// Returns the costs so far.
    SimulationRun result() const;

  private:
    void advance_one();
    void start_controller();
    void record_load();
    void record_step(bool is_recorded);
    std::vector<double> costs() const;
    std::vector<double> weights();
    bool is_due() const;
    void rebalance();
    void note_loads(SimulationRun& run) const;

    const SimulationPlan& plan_;
    std::optional<mpm::Balancer> balancer_;
    Observer observe_;
    MPI_Comm comm_;
    Cost cost_;
    const SimulationRun* repeated_;
    int num_ranks_ = 1;
    std::unique_ptr<mpm::Simulation> simulation_;
    std::optional<rrcb::Controller> controller_;
    std::optional<rrcb::experimental::CostModel> model_;
    SimulationRun run_;
    PhaseLog steps_;
    PhaseLog balances_;
    PhaseLog decisions_{Waits::in_the_next};  ///< the controller reduces during the next step
    std::vector<double> loads_;               ///< number of points on this rank in each step
    std::vector<double> counted_;             ///< instructions of this rank in each step
    struct {
        double seconds = 0;
        double points = 0;
        std::vector<double> columns;
    } undecided_;              ///< sums over the steps not yet passed to the controller
    double moved_lately_ = 0;  ///< share of the points moved by the last rebalance
    int steps_done_ = 0;
};

/// Returns the number of steps to the end of the scene with its initial time step. Collective over
/// `comm`.
int steps_to_end(const mpm::Scene& scene, MPI_Comm comm);

}  // namespace comparisons
