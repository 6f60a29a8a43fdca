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

/// Functions called by run() around the stages and after the steps of an arm.
struct Observer {
    /// Called instead of each stage of a measured step. Gets the index of the stage in
    /// stage_names() and a function that runs the stage, which it must call.
    std::function<void(std::size_t, const std::function<void()>&)> around;
    /// Called after every step, measured or not, with its number and the points.
    std::function<void(int, const Particles&)> after = [](int, const Particles&) {};
};

/// Returns the names of the measurements: all stages, then again the last two stages, for the steps
/// that keep points and ghosts.
std::vector<std::string> stage_names(const Arm& arm);

/// Runs an arm from the start of the flow. First come some steps that are not measured, then
/// `steps` measured steps, then as many measured steps in which no point moves. Collective.
void run(const Arm& arm, const Flow& flow, int steps, const Observer& observer);

/// The costs of a stage, as means over the ranks and steps.
struct StageCounts {
    double collectives = 0;
    double messages = 0;     ///< between two ranks
    double bytes = 0;        ///< of messages, and passed to and returned by collectives
    double allocations = 0;  ///< by operator new
    double bytes_allocated = 0;
};

/// Returns the counts of each of stage_names(). Traffic and memory are counted in separate runs.
/// Collective.
std::vector<StageCounts> count(std::string_view arm, const Flow& flow, int steps);

/// Checks that the points, ghosts and sums of all arms are the same.
class SameResults {
  public:
    /// Keeps the results of the first arm. Throws Failure if those of another arm are not
    /// bit-identical, apart from their order. No collective calls may follow a failure. Not
    /// collective.
    void check(std::string_view arm, int step, const Particles& particles);

  private:
    std::string first_{};
    std::map<int, Particles> results_{};
};

}  // namespace comparisons
