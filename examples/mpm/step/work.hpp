#pragma once

#include "transfer/transfers.hpp"

#include <ctime>
#include <span>
#include <vector>

namespace mpm {

/// Processor time of this thread between calls.
class WorkClock {
  public:
    void restart() {
        seconds_ = 0;
        resume();
    }
    void resume() { start_ = now(); }
    void pause() { seconds_ += now() - start_; }
    double seconds() const { return seconds_; }  ///< from restart to the last pause, without pauses

  private:
    static double now() {
        std::timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    double seconds_ = 0;
    double start_ = 0;
};

/// Parts of each point in the columns of Simulation::work_columns(), row after row.
///
/// The points of a run share it, and those that reach a node share that. An empty node is given to
/// the nearest one that is reached: behind a cut it goes with the points on the same side.
template <int D>
std::vector<double> point_columns(const GridPatch<D>& patch, std::span<const CellRun<D>> runs);

}  // namespace mpm
