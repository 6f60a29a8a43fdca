#include "comparison_mpi.hpp"
#include "partitioner_mpi.hpp"
#include "workload_mpi.hpp"

#include <rrcb/balance.hpp>

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
        return measure(workload_, methods, {lists, 3}, MPI_COMM_WORLD);
    }

    int num_ranks_ = 1;
    int rank_ = 0;
    Workload workload_;
};

TEST_F(MeasurementTest, exact_methods_are_exact_with_any_lists) {
    // 1200 points can be divided evenly by 1, 2, 3 and 4 ranks, and no two points share a
    // coordinate.
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

TEST_F(MeasurementTest, counted_keys_cut_the_curve_within_a_hundredth_of_a_part) {
    for (const Measurement& result :
         run(read_methods("hilbert-counts,zoltan-hsfc"), Lists::parts)) {
        EXPECT_EQ(result.error, "") << result.method;
        EXPECT_LE(result.imbalances.at(0), 1.01) << result.method;
        EXPECT_LT(result.traffic.bytes, 400'000) << result.method;
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
        // On one rank no point moves, unless the seed has just changed.
        if (num_ranks_ > 1) {
            EXPECT_EQ(open.traffic.bytes, fixed.traffic.bytes);
        }
    }
    std::ranges::sort(sizes);
    EXPECT_EQ(std::abs(open.worst_unbalance_percent), sizes[4]);
    EXPECT_EQ(open.times_ms.size(), 3U);
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

}  // namespace
}  // namespace comparisons
