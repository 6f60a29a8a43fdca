#pragma once

#include "failure_mpi.hpp"

#include <sched.h>

#include <vector>

namespace comparisons {

/// Binds each rank to another core in each turn, so that no rank is always on a slow core. Its
/// destructor lets the rank use all cores again.
class CoreRota {
  public:
    explicit CoreRota(MPI_Comm comm) : rank_(rank_of(comm)) {
        sched_getaffinity(0, sizeof(all_), &all_);
        for (int core = 0; core < CPU_SETSIZE; ++core)
            if (CPU_ISSET(core, &all_)) cores_.push_back(core);
    }
    CoreRota(const CoreRota&) = delete;
    CoreRota& operator=(const CoreRota&) = delete;
    ~CoreRota() { sched_setaffinity(0, sizeof(all_), &all_); }

    void bind(int turn) const {
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(cores_[static_cast<std::size_t>(rank_ + turn) % cores_.size()], &one);
        sched_setaffinity(0, sizeof(one), &one);
    }

  private:
    int rank_;
    cpu_set_t all_{};
    std::vector<int> cores_;
};

}  // namespace comparisons
