// The meeting of a call costs no messages beyond those that the call needs: counted below the
// library, over all ranks.
#include "mpi_layer.hpp"
#include "ranks.hpp"

#include <rrcb/cost.hpp>
#include <rrcb/paper.hpp>
#include <rrcb/rrcb.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;

const MPI_Comm world = MPI_COMM_WORLD;

/// Collective calls, and messages between two ranks, sent or received, of all ranks.
using Counts = std::array<long, 2>;

Counts counts_of(const std::function<void()>& call) {
    call();
    mpi_layer::fail_call(0);
    mpi_layer::fail_message(0);
    call();
    Counts counts{mpi_layer::counted_calls(), mpi_layer::counted_messages()};
    MPI_Allreduce(MPI_IN_PLACE, counts.data(), 2, MPI_LONG, MPI_SUM, world);
    return counts;
}

TEST(MessageCounts, table) {
    const std::vector<double> x{0.1 + rank(), 0.2, 0.3 + rank(), 0.4, 0.7 * rank(), 0.1};
    const Points points = interleaved_points(x, 2);
    std::vector<std::uint64_t> keys{1, 2, 3};
    const Balance made = balance(points, {}, world);
    const Plan lists = plan(made, world);
    const GhostPlan near = ghosts(made.cuts, points, {.radius = 0.1}, world);
    const Groups clusters = groups(points, keys, world);
    std::vector<RankRange> ranks;
    for (int r = 0; r < num_ranks(); ++r) ranks.push_back({r, 1});
    const auto print = [&](const char* name, const std::function<void()>& call) {
        const Counts counts = counts_of(call);
        if (rank() == 0)
            std::cout << name << ' ' << num_ranks() << ' ' << counts[0] / num_ranks() << ' '
                      << counts[1] / 2 << '\n';
    };
    print("balance", [&] { balance(points, {}, world); });
    print("rebalance", [&] { rebalance(points, {}, made.cuts, world); });
    print("balance_as_in_paper", [&] { balance_as_in_paper(points, {}, world); });
    print("plan", [&] { plan(made, world); });
    print("remap", [&] { remap(made.parts, ranks, world); });
    print("transfer", [&] { transfer(lists, column(x, 2), world); });
    print("ghosts", [&] { ghosts(made.cuts, points, {.radius = 0.1}, world); });
    print("fetch", [&] { fetch(near, column(x, 2), world); });
    print("groups", [&] { groups(points, keys, world); });
    print("fetch of groups", [&] { fetch(clusters, column(clusters.weights), world); });
    print("sums", [&] { sums(clusters, std::vector<double>(3, 1.0), world); });
    print("part_weights", [&] { part_weights(points, made, world); });
    print("moved_fraction", [&] { moved_fraction(points, made, world); });
    print("gather_cuts", [&] { gather_cuts(made.cuts, world); });
    print("assign_all", [&] { assign_all(made.cuts, points, world); });
    print("Controller", [&] { Controller{world}; });
    print("CostModel", [&] { CostModel{world, 1}; });
    Controller controller(world);
    print("Controller::step", [&] { controller.step(1); });
}

}  // namespace
}  // namespace rrcb
