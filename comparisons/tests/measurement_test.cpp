#include "comparison_mpi.hpp"
#include "cycle_mpi.hpp"
#include "partitioner_mpi.hpp"
#include "workload_mpi.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/zoltan/rrcb_zoltan.h>

#include <gtest/gtest.h>
#include <zoltan.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace comparisons {
namespace {

class MeasurementTest : public testing::Test {
  protected:
    void SetUp() override {
        float version = 0;
        Zoltan_Initialize(0, nullptr, &version);
        MPI_Comm_size(MPI_COMM_WORLD, &num_ranks_);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        workload_ = cloud_workload({"uniform", 1200, 2, 3}, Layout::scattered, MPI_COMM_WORLD);
    }

    std::vector<Measurement> run(std::span<const Method> methods, Lists lists) {
        Progress progress(false);
        return measure(workload_, methods, {lists, 3}, progress, MPI_COMM_WORLD);
    }

    int num_ranks_ = 1;
    int rank_ = 0;
    Workload workload_;
};

TEST_F(MeasurementTest, the_plug_in_is_active) {
    EXPECT_EQ(RRCB_Zoltan_Active(), 1);
}

TEST_F(MeasurementTest, exact_methods_are_exact_with_any_lists) {
    // 1200 points divide evenly by 1, 2, 3 and 4 ranks, and no two share a coordinate.
    const std::vector<Method> methods =
        read_methods("zoltan-rcb,zoltan-rib,root-rcb,rrcb-exact,rrcb-arrays[refine=exact]");
    for (const Lists lists : {Lists::parts, Lists::exports, Lists::all}) {
        for (const Measurement& result : run(methods, lists)) {
            EXPECT_EQ(result.error, "") << result.method;
            EXPECT_EQ(result.times_ms.size(), 3U);
            ASSERT_EQ(result.imbalances.size(), 1U) << result.method;
            EXPECT_DOUBLE_EQ(result.imbalances[0], 1) << result.method << ' ' << lists_name(lists);
            EXPECT_DOUBLE_EQ(result.worst_unbalance_percent, 0) << result.method;
        }
    }
}

TEST_F(MeasurementTest, all_lists_tell_the_same_parts) {
    const std::vector<Method> methods =
        read_methods("zoltan-rcb,zoltan-hsfc,rrcb-sampled,rrcb,rrcb-arrays");
    const std::vector<Measurement> by_parts = run(methods, Lists::parts);
    for (const Lists lists : {Lists::exports, Lists::all}) {
        const std::vector<Measurement> results = run(methods, lists);
        for (std::size_t m = 0; m < methods.size(); ++m) {
            EXPECT_EQ(results[m].parts, by_parts[m].parts) << methods[m].label;
        }
    }
}

TEST_F(MeasurementTest, of_a_drifting_cloud_tells_what_the_last_move_changes) {
    const std::vector<Method> methods = read_methods("zoltan-rcb,rrcb[tol=1.1,reuse]");
    Progress progress(false);
    const MeasurementPlan plan{Lists::parts, 3, 0.01, 5};
    const auto results = measure(workload_, methods, plan, progress, MPI_COMM_WORLD);
    const auto again = measure(workload_, methods, plan, progress, MPI_COMM_WORLD);
    for (std::size_t m = 0; m < results.size(); ++m) {
        EXPECT_EQ(results[m].error, "");
        EXPECT_LE(results[m].imbalances[0], 1.1);
        // A quarter of a square of which each side moves by a hundredth.
        EXPECT_LE(results[m].moved_fraction, 0.1);
        // Two parts may both move along their cut.
        if (num_ranks_ != 2) {
            EXPECT_EQ(results[m].moved_fraction > 0, num_ranks_ > 2);
        }
        EXPECT_EQ(results[m].moved_fraction, again[m].moved_fraction);
    }
    EXPECT_EQ(results[0].imbalances[0], 1) << "of the points where they are";
}

TEST_F(MeasurementTest, on_arrays_makes_the_parts_of_the_library) {
    const Method method = read_method("rrcb-arrays[mesh=2,tol=1.05]");
    const rrcb::Balance expected = balance(*method.options, workload_.points(), MPI_COMM_WORLD);
    EXPECT_EQ(run(std::vector{method}, Lists::parts)[0].parts, expected.parts);
}

TEST_F(MeasurementTest, pseudo_random_points_are_judged_over_ten_seeds) {
    const std::string start = "rrcb-sampled[mesh=2,fraction=0.05";
    const Measurement open = run(read_methods(start + "]"), Lists::parts)[0];
    ASSERT_EQ(open.imbalances.size(), 10U);
    std::vector<double> sizes;
    for (int seed = 1; seed <= 10; ++seed) {
        const std::string name = start + ",seed=" + std::to_string(seed) + "]";
        const Measurement fixed = run(read_methods(name), Lists::parts)[0];
        ASSERT_EQ(fixed.imbalances.size(), 1U);
        EXPECT_EQ(open.imbalances[static_cast<std::size_t>(seed) - 1], fixed.imbalances[0]) << seed;
        sizes.push_back(std::abs(fixed.worst_unbalance_percent));
        if (seed > 1) continue;
        EXPECT_EQ(open.parts, fixed.parts);
        // On one rank all points are at rest, unless the seed has just changed.
        if (num_ranks_ > 1) {
            EXPECT_EQ(open.traffic.bytes, fixed.traffic.bytes);
        }
    }
    std::ranges::sort(sizes);
    EXPECT_EQ(std::abs(open.worst_unbalance_percent), sizes[4]);
    EXPECT_EQ(open.times_ms.size(), 3U);
}

TEST_F(MeasurementTest, messages_to_the_root_are_made_of_the_sizes_that_are_told) {
    std::map<std::string, std::int64_t> sizes;
    const Row columns = Row().add("name", "").add("bytes", 0);
    for (const Row& row : read_csv(message_sizes_csv(2), columns))
        sizes[row.columns()[0].second] = read_number<std::int64_t>(row.columns()[1].second).value();
    // Of every cell of its mesh each rank holds points.
    const Measurement result = run(read_methods("rrcb[mesh=2,refine=none]"), Lists::parts)[0];
    const std::int64_t message =
        sizes["summary"] + sizes["mesh"] + 4 * sizes["cell"] + sizes["place"];
    const auto sent = result.calls.find("MPI_Send");
    ASSERT_EQ(sent != result.calls.end(), num_ranks_ > 1);
    if (num_ranks_ > 1) {
        EXPECT_EQ(sent->second.bytes_in, (num_ranks_ - 1) * message);
    }
}

TEST_F(MeasurementTest, lu_of_largest_size_keeps_its_sign) {
    EXPECT_EQ(largest_by_size(std::vector<double>{1, -3, 2}), -3);
    EXPECT_EQ(largest_by_size(std::vector<double>{1, -2, 2}), -2);
    EXPECT_EQ(largest_by_size(std::vector<double>{4, -3}), 4);
    EXPECT_EQ(largest_by_size({}), 0);
}

TEST_F(MeasurementTest, a_method_that_fails_leaves_the_others_alone) {
    std::vector<Method> methods = read_methods("zoltan-rcb,rrcb");
    methods.insert(methods.begin() + 1, {"broken", "NO_SUCH_METHOD", std::nullopt});
    const std::vector<Measurement> results = run(methods, Lists::parts);
    EXPECT_EQ(results[0].error, "");
    EXPECT_EQ(results[1].error, "Zoltan refuses the parameter LB_METHOD=NO_SUCH_METHOD");
    EXPECT_EQ(results[2].error, "");
    EXPECT_EQ(results[2].times_ms.size(), 3U);
}

TEST_F(MeasurementTest, coordinates_that_are_not_finite_fail_on_every_rank) {
    if (rank_ == num_ranks_ - 1)
        workload_.coordinates[3] = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Measurement> results = run(read_methods("rrcb,rrcb-arrays"), Lists::parts);
    EXPECT_EQ(results[0].error, "Zoltan_LB_Partition failed with code -1");
    EXPECT_EQ(results[1].error, "rrcb::balance failed with code -1");
}

TEST_F(MeasurementTest, still_points_go_to_the_rank_of_their_part_after_every_call) {
    std::vector<std::vector<double>> seen;
    const mpm::Balancer to_the_next = [&](mpm::Positions positions, MPI_Comm) {
        seen.emplace_back(positions.x.begin(), positions.x.end());
        mpm::Decomposition decomposition;
        decomposition.local_owners.assign(positions.size(), (rank_ + 1) % num_ranks_);
        return decomposition;
    };
    const std::vector<StillCall> calls =
        balance_still_points(workload_, to_the_next, num_ranks_ + 1, MPI_COMM_WORLD);
    ASSERT_EQ(calls.size(), static_cast<std::size_t>(num_ranks_) + 1);
    for (const StillCall& call : calls) EXPECT_EQ(call.moved_fraction, num_ranks_ > 1 ? 1 : 0);
    // Once around: every rank has its own points again.
    EXPECT_EQ(seen.front(), seen.back());
    const std::size_t mine = seen[1].size();
    std::size_t all = 0;
    MPI_Allreduce(&mine, &all, 1, MPI_UNSIGNED_LONG, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(all, 1200U);
}

TEST_F(MeasurementTest, still_points_stay_where_exact_cuts_put_them) {
    // 1200 points divide evenly by 1, 2, 3 and 4 ranks, and no two share a coordinate.
    for (const char* name : {"root-rcb", "rrcb-exact"}) {
        const std::vector<StillCall> calls =
            balance_still_points(workload_, *make_balancer(read_method(name)), 3, MPI_COMM_WORLD);
        for (const StillCall& call : calls) EXPECT_EQ(call.imbalance, 1) << name;
        EXPECT_EQ(calls[1].moved_fraction, 0) << name;
        EXPECT_EQ(calls[2].moved_fraction, 0) << name;
    }
}

}  // namespace
}  // namespace comparisons
