#include "cycle_mpi.hpp"
#include "error_sources_mpi.hpp"
#include "partitioner_mpi.hpp"
#include "workload_mpi.hpp"

#include <rrcb/bisection.hpp>
#include <rrcb/support_mesh.hpp>

#include <gtest/gtest.h>
#include <zoltan.h>

#include <cmath>
#include <numeric>

namespace comparisons {
namespace {

class StillPoints : public testing::Test {
  protected:
    void SetUp() override {
        float version = 0;
        Zoltan_Initialize(0, nullptr, &version);
        MPI_Comm_size(MPI_COMM_WORLD, &num_ranks_);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        workload_ = cloud_workload({"uniform", 1200, 2, 3}, Layout::scattered, MPI_COMM_WORLD);
    }

    int num_ranks_ = 1;
    int rank_ = 0;
    Workload workload_;
};

TEST_F(StillPoints, go_to_the_rank_of_their_part_after_every_call) {
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

TEST_F(StillPoints, stay_where_exact_cuts_put_them) {
    // 1200 points divide evenly by 1, 2, 3 and 4 ranks, and no two share a coordinate.
    for (const char* name : {"root-rcb", "rrcb-exact"}) {
        const std::vector<StillCall> calls =
            balance_still_points(workload_, *make_balancer(read_method(name)), 3, MPI_COMM_WORLD);
        for (const StillCall& call : calls) EXPECT_EQ(call.imbalance, 1) << name;
        EXPECT_EQ(calls[1].moved_fraction, 0) << name;
        EXPECT_EQ(calls[2].moved_fraction, 0) << name;
    }
}

// The model of docs/paper.md: points evenly on [0, 1], a rank on each side of a cut, m cells each,
// boxes of half-width k sigma; a box is r = k / sqrt(3) times as wide as its cell.
constexpr int num_points = 200'000;

/// The next cut as the library finds it, with boxes in place of samples.
double cut_after(double cut, int mesh, double k) {
    std::vector<double> x(num_points);
    for (int i = 0; i < num_points; ++i) x[static_cast<std::size_t>(i)] = (i + 0.5) / num_points;
    const auto num_below = static_cast<std::size_t>(std::lround(cut * num_points));
    std::vector<rrcb::CellMoments> cells;
    for (const auto side : {std::span(x).first(num_below), std::span(x).subspan(num_below)}) {
        const rrcb::Points points = rrcb::interleaved_points(side, 1, {});
        const std::vector<rrcb::CellMoments> of_side = rrcb::cell_moments(
            points, rrcb::make_support_mesh(rrcb::bounding_box(points), 1, mesh));
        cells.insert(cells.end(), of_side.begin(), of_side.end());
    }
    return rrcb::bisect(box_domain(cells, 1, k), 2, {}, rrcb::CutRule::weighted_fraction)
        .cuts.tree.front()
        .at[0];
}

/// The same by the model: offsets of the cuts from 1/2.
double modelled(double offset, int mesh, double k) {
    const double r = k / std::sqrt(3.0);
    if (r > 1) return offset * (1 - r / 2 + (r - 1) / (2 * mesh));
    const double cell = (0.5 + std::abs(offset)) / mesh;  // on the side with more points
    return -std::copysign((1 - r) * (cell / 2 - std::abs(offset)), offset);
}

TEST(CycleModel, tells_the_next_cut) {
    for (const int mesh : {2, 4, 8}) {
        for (const double k : {1.0, 1.5, std::sqrt(3.0), 2.0, 2.5}) {
            for (const double e : {-0.004, -0.001, 0.001, 0.004}) {
                EXPECT_NEAR(cut_after(0.5 + e, mesh, k), 0.5 + modelled(e, mesh, k), 2e-5)
                    << "mesh " << mesh << ", k " << k << ", offset " << e;
            }
        }
    }
}

TEST(CycleModel, alternates_where_boxes_are_narrower_than_their_cells) {
    const int mesh = 4;
    const double gap = 1 - 1.5 / std::sqrt(3.0);
    const double offset = gap / (4 * mesh) / (1 + gap * (1 - 1 / (2.0 * mesh)));
    double cut = 0.47;
    for (int call = 0; call < 10; ++call) cut = cut_after(cut, mesh, 1.5);
    EXPECT_NEAR(std::abs(cut - 0.5), offset, 2e-5);
    const double next = cut_after(cut, mesh, 1.5);
    EXPECT_NEAR(next - 0.5, 0.5 - cut, 2e-5);
}

TEST(CycleModel, comes_to_rest_where_a_box_is_its_cell_or_wider) {
    for (const double k : {std::sqrt(3.0), 2.0, 2.5}) {
        double cut = 0.48;
        for (int call = 0; call < 20; ++call) cut = cut_after(cut, 4, k);
        EXPECT_NEAR(cut, 0.5, 2e-5) << k;
    }
}

}  // namespace
}  // namespace comparisons
