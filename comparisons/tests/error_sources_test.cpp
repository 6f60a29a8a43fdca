#include "error_sources_mpi.hpp"
#include "workload_mpi.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/method/bisection.hpp>
#include <rrcb/method/support_mesh.hpp>
#include <rrcb/paper.hpp>
#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace comparisons {
namespace {

class ErrorSources : public testing::Test {
  protected:
    void SetUp() override {
        MPI_Comm_size(MPI_COMM_WORLD, &num_ranks_);
        workload_ = cloud_workload({"clusters", 1200, 2, 7}, Layout::scattered, MPI_COMM_WORLD);
    }

    std::vector<double> weights(const SourceSetting& setting) const {
        return source_part_weights(setting, workload_.points(), MPI_COMM_WORLD);
    }

    std::vector<double> weights(const rrcb::Options& options) const {
        return weights(rrcb::balance(workload_.points(), options, MPI_COMM_WORLD));
    }

    std::vector<double> weights(const rrcb::Balance& balance) const {
        return rrcb::part_weights(workload_.points(), balance.parts, num_ranks_, MPI_COMM_WORLD);
    }

    int num_ranks_ = 1;
    Workload workload_;
};

TEST_F(ErrorSources, cells_and_sampled_points_are_those_of_the_library) {
    rrcb::Options options;
    options.refine = rrcb::Refine::none;
    options.tuning.support_mesh = 5;
    EXPECT_EQ(weights({Source::cells, 5}), weights(options));
    rrcb::PaperOptions paper;
    paper.support_mesh = 5;
    paper.sigma_multiplier = 2;
    paper.sample_fraction = 0.5;
    paper.seed = 3;
    EXPECT_EQ(weights({Source::sampled, 5, 2, 0.5, 3}),
              weights(rrcb::balance_as_in_paper(workload_.points(), paper, MPI_COMM_WORLD)));
}

TEST_F(ErrorSources, all_points_leave_no_error) {
    // 1200 points divide evenly by 1, 2, 3 and 4 ranks, and no two share a coordinate.
    EXPECT_EQ(weights(SourceSetting{}), std::vector<double>(num_ranks_, 1200.0 / num_ranks_));
}

TEST_F(ErrorSources, many_samples_come_near_to_the_box_they_are_drawn_from) {
    const std::vector<double> box = weights({Source::boxes, 4, 1.5});
    const std::vector<double> sampled = weights({Source::sampled, 4, 1.5, 500, 1});
    // 600,000 samples: about 0.1 % of noise per cut, two of them at most.
    for (std::size_t part = 0; part < box.size(); ++part) {
        EXPECT_NEAR(sampled[part], box[part], 0.005 * 1200) << part;
    }
}

TEST(ErrorSource, box_reaches_k_sigma_beyond_the_mean_whatever_the_cell) {
    rrcb::CellMoments cell;
    cell.box = {{1.5, 0, 0}, {2.5, 8, 0}};
    cell.moments = {10, 20, {2, 4, 0}, {0.5, 3, 0}};
    const rrcb::StatisticalDomain domain = box_domain(std::span(&cell, 1), 2, 2);
    ASSERT_EQ(domain.patches.size(), 1U);
    EXPECT_EQ(domain.patches[0].lower, (rrcb::Vector{1, -2, 0}));
    EXPECT_EQ(domain.patches[0].upper, (rrcb::Vector{3, 10, 0}));
    EXPECT_EQ(domain.patches[0].weight, 20);
}

TEST(ErrorSource, settings_differ_and_go_from_the_points_to_the_samples) {
    const std::vector<SourceSetting> settings = source_settings(false);
    // All points; on each of 7 meshes the cells, 5 boxes, 2 cut off, and 5 fractions with 10 seeds.
    EXPECT_EQ(settings.size(), 1U + 7U * (1U + 5U + 2U + 50U));
    EXPECT_EQ(settings.front().source, Source::points);
    EXPECT_EQ(settings.back().source, Source::sampled);
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
    return rrcb::bisect(box_domain(cells, 1, k), 2, {}).cuts.tree.front().at[0];
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
