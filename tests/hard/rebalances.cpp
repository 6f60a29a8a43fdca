#include "rebalances.hpp"

#include "../support/ranks.hpp"
#include "cloud.hpp"
#include "mpi_handles.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace rrcb::hard_test {

namespace {

struct Resources {
    MpiHandles handles;
    std::ptrdiff_t files = 0;
    std::size_t bytes = 0;
};

Resources resources() {
    const std::filesystem::directory_iterator files("/proc/self/fd");
    return {mpi_handles(), std::distance(begin(files), end(files)), mallinfo2().uordblks};
}

void print(int num_steps, const Resources& held) {
    const MpiHandles& handles = held.handles;
    std::printf(
        "after %d steps rank 0 holds %zu bytes, %td files, %d communicators, "
        "%d datatypes, %d operations\n",
        num_steps, held.bytes, held.files, handles.communicators, handles.datatypes,
        handles.operations);
}

std::ptrdiff_t growth(const Resources& before, const Resources& after) {
    return static_cast<std::ptrdiff_t>(after.bytes) - static_cast<std::ptrdiff_t>(before.bytes);
}

}  // namespace

std::vector<double> moving_cloud(int step) {
    std::vector<double> coordinates;
    for (int k = 0; k < 400; ++k) {
        const int point = 400 * test::rank() + k;
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
    Resources before, between;
    for (int step = 0; step < num_steps; ++step) {
        if (step == num_steps / 3) before = resources();
        if (step == num_steps * 2 / 3) between = resources();
        take_step(step);
        // A rank that lags behind makes MPI keep the messages of the others.
        MPI_Barrier(MPI_COMM_WORLD);
    }
    const Resources after = resources();
    if (test::rank() == 0) {
        print(num_steps / 3, before);
        print(num_steps, after);
    }
    EXPECT_EQ(after.handles, before.handles);
    EXPECT_EQ(after.files, before.files);
    // What is lost is lost by every step. MPI's own store grows at times, once for many steps, by
    // how many messages happened to be on their way.
    constexpr std::ptrdiff_t slack = 32 * 1024;
    EXPECT_LE(std::min(growth(before, between), growth(between, after)), slack);
}

}  // namespace rrcb::hard_test
