#include "interval_recording_mpi.hpp"

#include "call_turns_mpi.hpp"
#include "part_loads_mpi.hpp"
#include "partitioner_mpi.hpp"
#include "phase_log_mpi.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace comparisons {

namespace {

/// Moves the points to their end; the work of all ranks in the steps, in s.
double move_all(MovingPoints& points, PointTracks& tracks, CallTurns& turns, int num_times,
                MPI_Comm comm) {
    const int num_steps = points.num_steps();
    PhaseLog steps;
    for (int step = 0; step <= num_steps; ++step) {
        while (tracks.num_times() * num_steps <= step * (num_times - 1)) tracks.add(points);
        if (step == num_steps) break;
        turns.act_before(step);
        MPI_Barrier(comm);
        steps.record([&] { points.step(); });
    }
    return steps.cost(comm).work_s;
}

/// Histories of the points that have moved, by the parts of several balancers.
struct Histories {
    const PointTracks& tracks;
    int num_steps;

    /// Parts are made by `make` at the first `num_made` times.
    template <typename Make>
    LoadHistory of(Make&& make, int num_made, std::vector<double> costs) const {
        LoadHistory history;
        history.num_steps = num_steps;
        const double scale = (tracks.num_times() - 1.0) / num_steps;
        history.load = [table = tracks.loads(make, num_made), scale](int made, int step) {
            return table->step(made * scale, step * scale);
        };
        history.cost = [costs = std::move(costs)](int step) {
            return costs[static_cast<std::size_t>(step)];
        };
        return history;
    }

    /// `mean_s` is what a step takes with the mean load.
    MappedMethod mapped(const Method& method, std::size_t number, const CallTurns& turns,
                        double mean_s) const {
        std::vector<double> costs;
        for (int step = 0; step < num_steps; ++step)
            costs.push_back(turns.cost(number, step).all_s / mean_s);
        const auto make = [&] { return *make_balancer(method); };
        const RebalanceCost cost = turns.cost(number, num_steps / 2);
        return {method.label, of(make, tracks.num_times(), std::move(costs)), turns.scale95(number),
                cost.all_s, cost.call_s};
    }

    /// The points stay in these parts.
    LoadHistory none(const mpm::Decomposition& parts) const {
        const auto make = [&] {
            return mpm::Balancer([&](mpm::Positions, MPI_Comm) { return parts; });
        };
        return of(make, 1, std::vector<double>(static_cast<std::size_t>(num_steps)));
    }
};

}  // namespace

RecordedScene record_intervals(MovingPoints& points, std::span<const Method> methods,
                               const IntervalRecording& recording, MPI_Comm comm) {
    const int num_steps = points.num_steps();
    const int num_times = std::min(recording.num_times, num_steps + 1);
    const mpm::Decomposition slabs = points.decomposition();
    PointTracks tracks(comm);
    // Turns are as far apart as rebalances are at best, in order of magnitude.
    const CallTurns::Plan plan{recording.num_windows, recording.num_turns, num_steps / 50};
    CallTurns turns(points, methods, plan, comm);
    const double work_s = move_all(points, tracks, turns, num_times, comm);

    int num_ranks = 1;
    MPI_Comm_size(comm, &num_ranks);
    const auto num_points = static_cast<double>(tracks.num_points());
    RecordedScene recorded;
    recorded.seconds_per_point = recording.seconds_per_point > 0 ? recording.seconds_per_point
                                                                 : work_s / num_points / num_steps;
    const double mean_s = recorded.seconds_per_point * num_points / num_ranks;
    const Histories histories{tracks, num_steps};
    recorded.map = {recording.scene, num_ranks, histories.none(slabs), {}};
    for (std::size_t m = 0; m < methods.size(); ++m)
        recorded.map.methods.push_back(histories.mapped(methods[m], m, turns, mean_s));
    return recorded;
}

}  // namespace comparisons
