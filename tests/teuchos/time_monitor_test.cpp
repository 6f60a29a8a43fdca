#include "../support/clouds.hpp"
#include "../support/ranks.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/teuchos/time_monitor.hpp>

#include <Teuchos_DefaultMpiComm.hpp>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>

namespace rrcb::teuchos {
namespace {

/// How often each stage was timed on this rank, in the order of `stages`.
std::vector<int> calls_of(const std::string& prefix) {
    std::vector<int> calls;
    for (const Stage stage : stages) {
        const auto timer = Teuchos::TimeMonitor::lookupCounter(prefix + name_of(stage));
        calls.push_back(timer.is_null() ? -1 : timer->numCalls());
    }
    return calls;
}

std::vector<int> calls_at_root_and_elsewhere(int root, int elsewhere, int refinements) {
    return {elsewhere, elsewhere,   test::rank() == 0 ? root : 0,
            elsewhere, refinements, elsewhere - refinements};
}

TEST(TimeMonitorObserver, times_every_stage_of_every_call) {
    TimeMonitorObserver observer("every: ");
    EXPECT_EQ(calls_of("every: "), std::vector<int>(stages.size(), 0));
    const auto cloud = test::uniform_cloud(300, 2, 3);
    Options options;
    options.observer = &observer;
    balance(interleaved_points(cloud, 2), options, {}, MPI_COMM_WORLD);
    options.refine = Refine::none;
    balance(interleaved_points(cloud, 2), options, {}, MPI_COMM_WORLD);
    EXPECT_EQ(calls_of("every: "), calls_at_root_and_elsewhere(2, 2, 1));
    EXPECT_GT(Teuchos::TimeMonitor::lookupCounter("every: moments")->totalElapsedTime(), 0.0);
}

TEST(TimeMonitorObserver, shares_the_timers_of_another_with_its_prefix) {
    const auto cloud = test::uniform_cloud(300, 2, 3);
    for (int call = 0; call < 2; ++call) {
        TimeMonitorObserver observer("shared: ");
        Options options;
        options.observer = &observer;
        balance(interleaved_points(cloud, 2), options, {}, MPI_COMM_WORLD);
    }
    EXPECT_EQ(calls_of("shared: "), calls_at_root_and_elsewhere(2, 2, 2));
}

TEST(TimeMonitorObserver, is_stopped_by_a_call_that_fails) {
    TimeMonitorObserver observer("failing: ");
    auto cloud = test::uniform_cloud(300, 2, 3);
    if (test::is_last_rank()) cloud[5] = std::numeric_limits<double>::infinity();
    Options options;
    options.observer = &observer;
    EXPECT_THROW(balance(interleaved_points(cloud, 2), options, {}, MPI_COMM_WORLD), Error);
    // The failure is broadcast where the cuts would be.
    EXPECT_EQ(calls_of("failing: "), (std::vector<int>{1, 1, 0, 1, 0, 0}));
    for (const Stage stage : stages) {
        EXPECT_FALSE(Teuchos::TimeMonitor::lookupCounter(std::string("failing: ") + name_of(stage))
                         ->isRunning());
    }
}

TEST(TimeMonitorObserver, has_its_timers_in_the_summary_of_all_ranks) {
    TimeMonitorObserver observer("summary: ");
    const auto cloud = test::uniform_cloud(300, 2, 3);
    Options options;
    options.observer = &observer;
    balance(interleaved_points(cloud, 2), options, {}, MPI_COMM_WORLD);
    std::ostringstream out;
    const Teuchos::RCP<const Teuchos::Comm<int>> comm =
        Teuchos::rcp(new Teuchos::MpiComm<int>(Teuchos::opaqueWrapper(MPI_COMM_WORLD)));
    Teuchos::TimeMonitor::summarize(comm.ptr(), out);
    if (test::rank() != 0) return;
    for (const Stage stage : stages)
        EXPECT_NE(out.str().find(std::string("summary: ") + name_of(stage)), std::string::npos)
            << out.str();
}

}  // namespace
}  // namespace rrcb::teuchos
