#pragma once

#include <istream>
#include <optional>

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

}  // namespace comparisons
