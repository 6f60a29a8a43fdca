#include "machine_load_mpi.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace comparisons {
namespace {

std::optional<double> read(const std::string& stat) {
    std::istringstream in(stat);
    return read_busy_seconds(in, 100);
}

TEST(MachineLoad, reads_the_busy_time_of_all_cores) {
    // user nice system idle iowait irq softirq steal guest guest_nice, in 1/100 s
    EXPECT_DOUBLE_EQ(read("cpu  1000 20 300 90000 5000 4 6 70 900 8\ncpu0 500 10\n").value(), 14);
    for (const char* other : {"", "procs_running 3\n", "cpu 1 2\ncpu0 1 2\n", "cpu 1 2 3 4\n"})
        EXPECT_FALSE(read(other)) << other;
}

std::string lines(const MachineUse& use) {
    std::ostringstream out;
    write_use(out, use);
    print_warning(out, use);
    return out.str();
}

TEST(MachineLoad, warns_of_a_busy_machine) {
    EXPECT_EQ(lines({0.254, 1.5, 4, 2}),
              "load average at the start: 1.50\n"
              "processor time used by other processes: 25 %\n"
              "busy: yes\n"
              "ranks per core: 4 ranks share 2 cores\n"
              "busy machine: other processes used 25 % of it while this ran; times are not to be "
              "trusted\n");
    EXPECT_EQ(lines({0.1, 0.5, 2, 2}),
              "load average at the start: 0.50\n"
              "processor time used by other processes: 10 %\n"
              "busy: no\n");
}

TEST(MachineLoad, leaves_blank_what_is_unknown) {
    EXPECT_EQ(lines({std::nullopt, 0.5, 4, 4}),
              "load average at the start: 0.50\n"
              "processor time used by other processes: \n"
              "busy: \n");
}

}  // namespace
}  // namespace comparisons
