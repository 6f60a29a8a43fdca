#include "rebalances.hpp"

#include "../support/held_memory.hpp"
#include "../support/mpi_handles.hpp"
#include "../support/ranks.hpp"
#include "cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace rrcb::hard_test {

namespace {

struct Resources {
    test::MpiHandles handles;
    std::ptrdiff_t files = 0;
    test::HeldMemory memory;
};

Resources resources() {
    using std::filesystem::directory_iterator;
    const auto num_files = std::distance(directory_iterator("/proc/self/fd"), {});
    return {test::mpi_handles(), num_files, {}};
}

void print(int num_steps, const Resources& held) {
    const test::MpiHandles& handles = held.handles;
    std::printf(
        "after %d steps rank 0 holds %ld bytes, %td files, %d communicators, "
        "%d datatypes, %d operations\n",
        num_steps, held.memory.bytes, held.files, handles.communicators, handles.datatypes,
        handles.operations);
}

}  // namespace

std::vector<double> moving_cloud(int step) {
    std::vector<double> coordinates;
    for (int k = 0; k < 400; ++k) {
        const int point = 400 * rank() + k;
        const double angle = 0.02 * step + uniform(point, 0);
        const double radius = 1 + uniform(point, 1);
        coordinates.push_back(radius * std::cos(angle));
        coordinates.push_back(radius * std::sin(angle));
    }
    return coordinates;
}

void expect_constant_resources(const std::function<void(int step)>& take_step) {
    const char* asked = std::getenv("RRCB_TEST_REBALANCES");
    const int num_steps = asked == nullptr ? 150 : std::atoi(asked);
    // The same points and options come again after a period, so that the same is held.
    constexpr int period = 60;
    const int first = period + num_steps % period;
    Resources before;
    for (int step = 0; step < num_steps; ++step) {
        if (step == first) before = resources();
        take_step(step % period);
    }
    const Resources after = resources();
    if (rank() == 0) {
        print(first, before);
        print(num_steps, after);
    }
    EXPECT_EQ(after.handles, before.handles);
    EXPECT_EQ(after.files, before.files);
    test::expect_no_growth(before.memory, num_steps - first);
}

}  // namespace rrcb::hard_test
