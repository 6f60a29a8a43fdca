#include "rebalances.hpp"

#include "../support/mpi_handles.hpp"
#include "../support/ranks.hpp"
#include "cloud.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/paper.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

namespace rrcb::hard_test {
namespace {

TEST(Rebalances, hold_what_they_held) {
    std::vector<double> weights(400, 1.5);
    std::vector<double> coordinates;
    Cuts cuts;
    Options options{.num_parts = 5};
    expect_constant_resources([&](int step) {
        coordinates = moving_cloud(step);
        const Points points(coordinates, 2, weights);
        const bool reuses = step % 3 == 1;
        options.refine = step % 2 == 0 ? Refine::tolerance : Refine::exact;
        const Balance result = reuses ? balance(points, MPI_COMM_WORLD, options, cuts)
                                      : balance(points, MPI_COMM_WORLD, options);
        cuts = result.cuts;
        plan(result.parts, options.num_parts, MPI_COMM_WORLD);
        PaperOptions paper{.domain = step % 5 == 2 ? PaperDomain::sampled : PaperDomain::points};
        balance_as_in_paper(points, MPI_COMM_WORLD, paper);
        part_weights(points, result.parts, options.num_parts, MPI_COMM_WORLD);
    });
}

TEST(Rebalances, leave_nothing_on_a_communicator_that_is_freed) {
    const std::vector<double> coordinates = moving_cloud(0);
    const auto balance_once = [&](MPI_Comm given) {
        MPI_Comm comm = MPI_COMM_NULL;
        MPI_Comm_dup(given, &comm);
        balance(Points(coordinates, 2), comm);
        MPI_Comm_free(&comm);
    };
    balance_once(MPI_COMM_WORLD);
    const test::MpiHandles before = test::mpi_handles();
    for (int k = 0; k < 20; ++k) balance_once(MPI_COMM_WORLD);
    EXPECT_EQ(test::mpi_handles(), before);
}

}  // namespace
}  // namespace rrcb::hard_test
