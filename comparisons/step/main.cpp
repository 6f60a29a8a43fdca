// Measures the services of a step for several arms and prints CSV on standard output.
//
//   mpirun -n 4 rrcb_step counts DIMENSION POINTS STEPS ARM ...
//       traffic and memory of each stage, mean over ranks and steps; all arms must give the same
//   ... rrcb_step instructions DIMENSION POINTS STEPS ARM ...
//       the stages in the order of their calls; Callgrind counts within rrcb_step_stage()
//   ... rrcb_step clock DIMENSION POINTS STEPS ROUND ARM ...
//       seconds of a step, the arms in an order drawn for the round, then backwards
//   ... rrcb_step jump DIMENSION POINTS
//       calls after which each rank knows of a point that has passed all neighbours of rank 0
//
// POINTS are those of a rank. An arm may be named twice. comparisons/studies/run step makes tables.
#include "arms_mpi.hpp"
#include "counter_random.hpp"
#include "counts_mpi.hpp"
#include "failure.hpp"
#include "far_jump_mpi.hpp"
#include "flow_mpi.hpp"
#include "row.hpp"

#include <mpi.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

/// Runs a stage. Callgrind counts inside this function.
extern "C" [[gnu::noinline]] void rrcb_step_stage(const std::function<void()>& call) {
    call();
    // Prevents a tail call, which would leave this function before `call` runs.
    asm volatile("" ::: "memory");
}

namespace {

using namespace comparisons;
using Words = std::vector<std::string>;

void print_on_root(const Flow& flow, const Row& row) {
    if (flow.rank() == 0) print(row);
}

void print_counts(const Flow& flow, int steps, const Words& arms) {
    SameResults results;
    for (const std::string& name : arms) {
        const Arm arm = make_arm(name, flow);
        run(arm, flow, steps,
            {[](std::size_t, const std::function<void()>& call) { call(); },
             [&](int step, const Particles& p) { results.check(name, step, p); }});
        const std::vector<std::string> names = stage_names(arm);
        const std::vector<StageCounts> counts = count(name, flow, steps);
        for (std::size_t k = 0; k < names.size(); ++k)
            print_on_root(flow, Row()
                                    .add("arm", name)
                                    .add("stage", names[k])
                                    .add("collectives", counts[k].collectives)
                                    .add("messages", counts[k].messages)
                                    .add("bytes", counts[k].bytes)
                                    .add("allocations", counts[k].allocations)
                                    .add("bytes_allocated", counts[k].bytes_allocated));
    }
}

void print_stages(const Flow& flow, int steps, const Words& arms) {
    for (const std::string& name : arms) {
        const Arm arm = make_arm(name, flow);
        const std::vector<std::string> names = stage_names(arm);
        run(arm, flow, steps, {[&](std::size_t stage, const std::function<void()>& call) {
                rrcb_step_stage(call);
                print_on_root(flow, Row().add("arm", name).add("stage", names[stage]));
            }});
    }
}

/// Returns the seconds that the services of a step take on the slowest rank. Steps in which nothing
/// moves are not counted.
double seconds_of(const std::string& name, const Flow& flow, int steps) {
    double seconds = 0;
    const Arm arm = make_arm(name, flow);
    run(arm, flow, steps, {[&](std::size_t stage, const std::function<void()>& call) {
            // Ranks wait for each other after the work of a step. This wait is not measured.
            if (stage == 0 || stage + 1 == arm.size()) MPI_Barrier(flow.comm());
            const double start = MPI_Wtime();
            call();
            if (stage < arm.size()) seconds += MPI_Wtime() - start;
        }});
    MPI_Allreduce(MPI_IN_PLACE, &seconds, 1, MPI_DOUBLE, MPI_MAX, flow.comm());
    return seconds / steps;
}

void print_times(const Flow& flow, int steps, int round, const Words& arms) {
    for (const int turn : {2 * round, 2 * round + 1})
        for (const std::size_t k : drawn_order(arms.size(), 1, static_cast<std::uint64_t>(turn)))
            print_on_root(flow, Row()
                                    .add("turn", turn)
                                    .add("place", k)
                                    .add("arm", arms[k])
                                    .add("seconds", seconds_of(arms[k], flow, steps)));
}

void print_discoveries(const Flow& flow) {
    for (const Discovery& found : jump_far(flow))
        print_on_root(flow, Row()
                                .add("calls", found.calls)
                                .add("points", found.points)
                                .add("is_known", static_cast<int>(found.is_known)));
}

void measure(const Words& words) {
    const bool jumps = !words.empty() && words[0] == "jump";
    const std::size_t num_numbers = !words.empty() && words[0] == "clock" ? 5 : 4;
    if (words.size() < 3 || (!jumps && words.size() <= num_numbers))
        throw Failure("more arguments are needed; see the source");
    const int dimension = std::stoi(words[1]);
    if (dimension < 2 || dimension > 3) throw Failure("the dimension must be 2 or 3");
    const Flow flow(dimension, std::stoll(words[2]), MPI_COMM_WORLD);
    if (jumps) return print_discoveries(flow);
    const int steps = std::stoi(words[3]);
    if (steps < 1) throw Failure("steps must be 1 or more");
    const Words arms(words.begin() + static_cast<std::ptrdiff_t>(num_numbers), words.end());
    if (words[0] == "counts")
        print_counts(flow, steps, arms);
    else if (words[0] == "instructions")
        print_stages(flow, steps, arms);
    else if (words[0] == "clock")
        print_times(flow, steps, std::stoi(words[4]), arms);
    else
        throw Failure("'" + words[0] + "' is none of counts, instructions and clock");
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    try {
        measure(Words(argv + 1, argv + argc));
    } catch (const std::exception& error) {
        std::cerr << "rrcb_step: " << error.what() << '\n';
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    MPI_Finalize();
    return 0;
}
