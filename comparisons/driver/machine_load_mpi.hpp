#pragma once

#include <mpi.h>

#include <istream>
#include <optional>
#include <ostream>

namespace comparisons {

/// Processor time of all cores since the system started, in s, from /proc/stat of Linux; nothing if
/// it holds something else.
///
/// Waiting for a disk is idle; time that a host took from a virtual machine is busy. `ticks` are
/// its units a second.
std::optional<double> read_busy_seconds(std::istream& stat, double ticks);

/// What the machines of a run were busy with.
struct MachineUse {
    std::optional<double> share_of_others;  ///< of the node where it is largest; 0 ... 1
    double load_average = 0;                ///< of rank 0's node when the run started
    int num_ranks = 1;                      ///< of that node
    int num_cores = 0;                      ///< of that node

    /// Others took so much that times are not to be trusted.
    bool is_busy() const { return share_of_others.value_or(0) > 0.1; }
};

/// Watches from its making on. All functions are collective over `comm`.
class MachineWatch {
  public:
    explicit MachineWatch(MPI_Comm comm);

    /// Until now.
    MachineUse use() const;

  private:
    MPI_Comm comm_;
    double start_s_ = 0;
    double own_s_ = 0;  ///< processor time of this rank
    std::optional<double> busy_s_;
    double load_average_ = 0;
};

/// The lines of run.txt, `name: value`.
void write_use(std::ostream& out, const MachineUse& use);

/// The warning that opens a summary; nothing when the machine was not busy.
void print_warning(std::ostream& out, const MachineUse& use);

}  // namespace comparisons
