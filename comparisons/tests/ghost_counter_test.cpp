#include "../../tests/support/ranks.hpp"
#include "ghosts_mpi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace comparisons {
namespace {

using Position = std::array<double, 3>;

struct Partition {
    std::vector<Position> points;
    std::vector<rrcb::Part> parts;
    int num_parts;
    int dimension = 2;
};

/// Counts the ghosts by testing every pair of points.
Ghosts reference(const Partition& all, double radius, std::optional<int> ranks_per_node) {
    std::vector<std::int64_t> needed(static_cast<std::size_t>(all.num_parts));
    std::vector<std::set<rrcb::Part>> neighbours(needed.size());
    Ghosts result{radius};
    std::int64_t off_machine = 0;
    for (std::size_t i = 0; i < all.points.size(); ++i) {
        std::set<rrcb::Part> near;
        for (std::size_t j = 0; j < all.points.size(); ++j) {
            double squared = 0;
            for (std::size_t axis = 0; axis < 3; ++axis)
                squared += (all.points[i][axis] - all.points[j][axis]) *
                           (all.points[i][axis] - all.points[j][axis]);
            if (all.parts[j] != all.parts[i] && squared <= radius * radius)
                near.insert(all.parts[j]);
        }
        for (const rrcb::Part part : near) {
            ++needed[static_cast<std::size_t>(part)];
            neighbours[static_cast<std::size_t>(part)].insert(all.parts[i]);
            const int machine = ranks_per_node.value_or(1);
            off_machine += part / machine != all.parts[i] / machine;
        }
    }
    for (std::size_t part = 0; part < needed.size(); ++part) {
        result.sum += needed[part];
        result.most = std::max(result.most, needed[part]);
        result.most_neighbours =
            std::max(result.most_neighbours, static_cast<int>(neighbours[part].size()));
    }
    if (ranks_per_node) result.off_machine = off_machine;
    return result;
}

/// Counts the ghosts by GhostCounter. Point i is on rank i modulo the number of ranks.
Ghosts counted(const Partition& all, const GhostRule& rule) {
    Workload mine;
    mine.dimension = all.dimension;
    std::vector<rrcb::Part> parts;
    for (std::size_t i = 0; i < all.points.size(); ++i) {
        if (static_cast<int>(i % 7) % rrcb::test::num_ranks() != rrcb::test::rank()) continue;
        const auto& x = all.points[i];
        mine.coordinates.insert(mine.coordinates.end(), x.begin(), x.begin() + all.dimension);
        parts.push_back(all.parts[i]);
    }
    return GhostCounter(mine, rule, MPI_COMM_WORLD).count(parts, all.num_parts);
}

void expect_equal(const Ghosts& found, const Ghosts& expected) {
    EXPECT_EQ(found.sum, expected.sum);
    EXPECT_EQ(found.most, expected.most);
    EXPECT_EQ(found.most_neighbours, expected.most_neighbours);
    EXPECT_EQ(found.off_machine, expected.off_machine);
}

/// Returns a cloud of 600 points, divided into strips of equal width along the longest axis or
/// dealt out one by one.
Partition cloud(const std::string& name, int dimension, int num_parts, bool in_strips) {
    Partition all{{}, {}, num_parts, dimension};
    const std::vector<double> coordinates = cloud_points({name, 600, dimension, 5}, 0, 600);
    for (std::size_t i = 0; i < coordinates.size(); i += static_cast<std::size_t>(dimension)) {
        Position x{};
        std::copy_n(coordinates.begin() + static_cast<std::ptrdiff_t>(i), dimension, x.begin());
        all.points.push_back(x);
    }
    const auto [low, high] = std::ranges::minmax(all.points);
    for (const Position& x : all.points) {
        const double place = (x[0] - low[0]) / (high[0] - low[0]) * num_parts;
        const int dealt = static_cast<int>(all.parts.size()) % num_parts;
        all.parts.push_back(in_strips ? std::min(static_cast<int>(place), num_parts - 1) : dealt);
    }
    return all;
}

TEST(GhostCounter, counts_what_every_pair_of_points_tells) {
    for (const int dimension : {2, 3}) {
        for (const char* name : {"uniform", "clusters", "lattice", "slope"}) {
            for (const bool in_strips : {true, false}) {
                const Partition all = cloud(name, dimension, 5, in_strips);
                for (const double radius : {0.01, 1.0, 3.0, 40.0, 1e4}) {
                    SCOPED_TRACE(std::string(name) + ' ' + std::to_string(radius));
                    expect_equal(counted(all, {radius, 2}), reference(all, radius, 2));
                }
            }
        }
    }
}

TEST(GhostCounter, takes_twice_the_median_spacing) {
    // There are 40 points in ten rows of four, and some that are far from all others.
    Partition all{{}, {}, 2};
    for (int i = 0; i < 40; ++i) {
        all.points.push_back({i % 4 + 0.0, i / 4 + 0.0, 0});
        all.parts.push_back(i / 20);
    }
    for (const double far : {1e3, 2e3, 3e3}) {
        all.points.push_back({far, far, 0});
        all.parts.push_back(0);
    }
    const Ghosts ghosts = counted(all, {});
    EXPECT_EQ(ghosts.radius, 2);
    // Two rows on each side of the cut are ghosts.
    EXPECT_EQ(ghosts.sum, 16);
    EXPECT_FALSE(ghosts.off_machine);
}

TEST(GhostCounter, of_coincident_points_every_part_needs_all_others) {
    Partition all{std::vector<Position>(90, {7, -3, 0}), {}, 3};
    for (int i = 0; i < 90; ++i) all.parts.push_back(i % 3);
    for (const GhostRule& rule : {GhostRule{}, GhostRule{1e-9, {}}}) {
        const Ghosts ghosts = counted(all, rule);
        EXPECT_EQ(ghosts.sum, 180);
        EXPECT_EQ(ghosts.most, 60);
        EXPECT_EQ(ghosts.most_neighbours, 2);
    }
}

TEST(GhostCounter, distance_is_taken_up_to_the_radius_itself) {
    const Partition all{{{0, 0, 0}, {0.5, 0, 0}}, {0, 1}, 2};
    EXPECT_EQ(counted(all, {0.5, {}}).sum, 2);
    EXPECT_EQ(counted(all, {0.4999999, {}}).sum, 0);
}

TEST(GhostCounter, there_are_none_of_one_part_of_no_points_and_of_points_that_are_not_finite) {
    Partition all = cloud("uniform", 3, 1, true);
    expect_equal(counted(all, {50, 1}), {50, 0, 0, 0, 0});
    expect_equal(counted({{}, {}, 4}, {}), {0, 0, 0, 0, std::nullopt});
    constexpr double infinity = std::numeric_limits<double>::infinity();
    all = {{{0, 0, 0}, {1, infinity, 0}, {2, std::nan(""), 0}, {0, 0, 0}}, {0, 1, 2, 3}, 4};
    expect_equal(counted(all, {9, {}}), {9, 2, 1, 1, std::nullopt});
}

TEST(GhostCounter, a_small_radius_in_a_wide_box_does_no_harm) {
    const Partition all{{{-1e9, 0, 0}, {1e9, 0, 0}, {1e9, 1e-7, 0}}, {0, 1, 0}, 2};
    expect_equal(counted(all, {1e-6, {}}), {1e-6, 2, 1, 1, std::nullopt});
}

}  // namespace
}  // namespace comparisons
