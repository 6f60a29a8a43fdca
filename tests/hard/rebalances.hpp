#pragma once

#include <functional>
#include <vector>

namespace rrcb::hard_test {

/// 400 points of this rank, in 2-D, at a step of their way round.
std::vector<double> moving_cloud(int step);

/// Takes as many steps as RRCB_TEST_REBALANCES says, 150 without it, and fails when memory, handles
/// of MPI or files are more at the end than after an earlier round of 60 steps. Collective.
void expect_constant_resources(const std::function<void(int step)>& take_step);

}  // namespace rrcb::hard_test
