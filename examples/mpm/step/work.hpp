#pragma once

#include "transfer/transfers.hpp"

#include <ctime>
#include <span>
#include <vector>

namespace mpm {

/// Measures the processor time of this thread.
class WorkClock {
  public:
    void restart() {
        seconds_ = 0;
        resume();
    }
    void resume() { start_ = now(); }
    void pause() { seconds_ += now() - start_; }
    double seconds() const {
        return seconds_;
    }  ///< time from restart to the last pause, without
       ///< the pauses between

  private:
    static double now() {
        std::timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    double seconds_ = 0;
    double start_ = 0;
};

/// Returns the share of each point in the columns of Simulation::work_columns(), one row per point.
///
/// The points of a run share the run, and the points that reach a node share the node. A node that
/// no point reaches is assigned to the nearest node that a point reaches. If a cut divides the
/// points, the empty node goes with the points on its side.
template <int D>
std::vector<double> point_columns(const GridPatch<D>& patch, std::span<const CellRun<D>> runs);

}  // namespace mpm
