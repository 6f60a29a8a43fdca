#pragma once

#include "arms_mpi.hpp"
#include "flow_mpi.hpp"
#include "particles.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace comparisons {

/// What surrounds the calls of an arm while it runs.
struct Observer {
    /// Makes the call of the stage with that number in stage_names(); not in steps before those
    /// that are measured.
    std::function<void(std::size_t, const std::function<void()>&)> around;
    /// Gets the number of the step, also of the others, and the points after it.
    std::function<void(int, const Particles&)> after = [](int, const Particles&) {};
};

/// Names of what is measured: the stages, then the last two in steps that keep points and ghosts.
std::vector<std::string> stage_names(const Arm& arm);

/// Runs an arm from the start of the flow: some steps that are not measured, then `steps` that are,
/// then as many in which no point moves. Collective.
void run(const Arm& arm, const Flow& flow, int steps, const Observer& observer);

/// Costs of a stage: mean over the ranks and steps.
struct StageCounts {
    double collectives = 0;
    double messages = 0;     ///< between two ranks
    double bytes = 0;        ///< of messages, and into and out of collectives
    double allocations = 0;  ///< by operator new
    double bytes_allocated = 0;
};

/// Counts each of stage_names(), traffic and memory in runs of their own. Collective.
std::vector<StageCounts> count(std::string_view arm, const Flow& flow, int steps);

/// Compares the points, ghosts and sums of arms.
class SameResults {
  public:
    /// Keeps the results of the first arm, and throws Failure if those of another differ in a bit,
    /// save their order. Collective calls then end. Not collective.
    void check(std::string_view arm, int step, const Particles& particles);

  private:
    std::string first_{};
    std::map<int, Particles> results_{};
};

}  // namespace comparisons
