#include "error_sources_mpi.hpp"
#include "workload_mpi.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <algorithm>

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
        const rrcb::Balance balance = rrcb::balance(workload_.points(), options, MPI_COMM_WORLD);
        return rrcb::part_weights(workload_.points(), balance.parts, num_ranks_, MPI_COMM_WORLD);
    }

    int num_ranks_ = 1;
    Workload workload_;
};

TEST_F(ErrorSources, cells_and_sampled_points_are_those_of_the_library) {
    rrcb::Options options;
    options.refine = rrcb::Refine::none;
    options.support_mesh = 5;
    EXPECT_EQ(weights({Source::cells, 5}), weights(options));
    options.domain = rrcb::DomainKind::sampled;
    options.sigma_multiplier = 2;
    options.sample_fraction = 0.5;
    options.seed = 3;
    EXPECT_EQ(weights({Source::sampled, 5, 2, 0.5, 3}), weights(options));
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

}  // namespace
}  // namespace comparisons
