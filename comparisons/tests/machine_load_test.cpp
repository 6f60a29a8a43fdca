#include "machine_load_mpi.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace comparisons {
namespace {

std::optional<ProcessorTime> read(const std::string& stat) {
    std::istringstream in(stat);
    return read_processor_time(in, 100);
}

TEST(MachineLoad, reads_the_busy_time_of_all_cores) {
    // user nice system idle iowait irq softirq steal guest guest_nice, in 1/100 s
    const std::optional<ProcessorTime> time = read(
        "cpu  1000 20 300 90000 5000 4 6 70 900 8\n"
        "cpu0 500 10 150 45000 2500 2 3 35 450 4\n"
        "cpu1 500 10 150 45000 2500 2 3 35 450 4\n"
        "intr 1 2 3\ncpu is no line of the head\n");
    ASSERT_TRUE(time);
    EXPECT_DOUBLE_EQ(time->busy_s, 14);
    EXPECT_EQ(time->num_cores, 2);
}

TEST(MachineLoad, is_unknown_where_the_system_tells_something_else) {
    EXPECT_FALSE(read(""));
    EXPECT_FALSE(read("procs_running 3\n"));
    EXPECT_FALSE(read("cpu 1 2\ncpu0 1 2\n"));
    EXPECT_FALSE(read("cpu 1 2 3 4\n"));
}

TEST(MachineLoad, leaves_out_the_time_of_this_program) {
    // 30 of 10 s on 4 cores were used, 22 of them by this program.
    EXPECT_DOUBLE_EQ(share_of_others({100, 4}, {130, 4}, 22, 10).value(), 8.0 / 40);
    // Ticks are coarse: this program may seem to have used more than all.
    EXPECT_EQ(share_of_others({100, 4}, {101, 4}, 1.5, 10).value(), 0);
    EXPECT_FALSE(share_of_others({100, 4}, {101, 4}, 1, 0));
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
}

TEST(MachineLoad, does_not_warn_of_a_tenth) {
    EXPECT_EQ(lines({0.1, 0.5, 2, 2}),
              "load average at the start: 0.50\n"
              "processor time used by other processes: 10 %\n"
              "busy: no\n");
}

TEST(MachineLoad, leaves_blank_what_is_unknown) {
    EXPECT_EQ(lines({std::nullopt, std::nullopt, 4, 4}),
              "load average at the start: \n"
              "processor time used by other processes: \n"
              "busy: \n");
}

}  // namespace
}  // namespace comparisons
