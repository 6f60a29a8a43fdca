#pragma once

#include <mpi.h>

#include <istream>
#include <optional>
#include <ostream>

namespace comparisons {

/// What the system has counted since it started.
struct ProcessorTime {
    double busy_s = 0;  ///< of all cores together, of all processes
    int num_cores = 0;
};

/// Reads what /proc/stat of Linux holds; nothing when it holds something else.
///
/// Waiting for a disk is idle; time that a host took from a virtual machine is busy. `ticks` are
/// its units a second.
std::optional<ProcessorTime> read_processor_time(std::istream& stat, double ticks);

/// Share of the processor time of `wall_s` seconds that others used than this program, whose
/// processes used `own_s`; 0 ... 1. Nothing without a wall time or cores.
std::optional<double> share_of_others(const ProcessorTime& start, const ProcessorTime& end,
                                      double own_s, double wall_s);

/// What the machines of a run were busy with.
struct MachineUse {
    std::optional<double> share_of_others;  ///< of the node where it is largest; 0 ... 1
    std::optional<double> load_average;     ///< of rank 0's node when the run started
    int num_ranks = 1;                      ///< of that node
    int num_cores = 0;                      ///< of that node; 0 where the system does not tell

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
    std::optional<ProcessorTime> time_;
    std::optional<double> load_average_;
};

/// The lines of run.txt, `name: value`.
void write_use(std::ostream& out, const MachineUse& use);

/// The warning that opens a summary; nothing when the machine was not busy.
void print_warning(std::ostream& out, const MachineUse& use);

}  // namespace comparisons
