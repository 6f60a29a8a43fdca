#pragma once

#include <ctime>

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

}  // namespace mpm
