// Ghosts by cuts that are spread over the ranks, beside those by the whole tree.
#include "../support/clouds.hpp"
#include "partial_trees.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/cuts.hpp>
#include <rrcb/error.hpp>
#include <rrcb/ghosts.hpp>

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace rrcb {
namespace {

using test::known_here;
using test::num_ranks;
using test::random_cuts;
using test::rank;

using Given = std::optional<std::vector<RankRange>>;

GhostPlan ghosts_of(const Cuts& cuts, const Points& points, double radius, const Given& given) {
    return ghosts(cuts, points, {.radius = radius, .ranks_of_parts = given}, MPI_COMM_WORLD);
}

void expect_same(const std::vector<RankCount>& counts, const std::vector<RankCount>& expected) {
    ASSERT_EQ(counts.size(), expected.size());
    for (std::size_t k = 0; k < counts.size(); ++k) {
        EXPECT_EQ(counts[k].rank, expected[k].rank);
        EXPECT_EQ(counts[k].count, expected[k].count);
    }
}

/// Compares the plans by both; gives how many points this rank sends.
std::size_t expect_same_plans(const Cuts& whole, const Cuts& known, const Points& points,
                              double radius, const Given& given = std::nullopt) {
    const GhostPlan expected = ghosts_of(whole, points, radius, given);
    const GhostPlan found = ghosts_of(known, points, radius, given);
    EXPECT_EQ(found.num_points, expected.num_points);
    EXPECT_EQ(found.send_indices, expected.send_indices);
    expect_same(found.send, expected.send);
    expect_same(found.receive, expected.receive);
    return found.send_indices.size();
}

/// Positions of this rank on and off the cuts; every third rank has none.
std::vector<double> positions_here(int dimension) {
    std::mt19937_64 engine(static_cast<unsigned>(rank() + 1));
    std::vector<double> coordinates(rank() % 3 == 2 ? 0 : static_cast<std::size_t>(60 * dimension));
    for (double& x : coordinates) x = static_cast<double>(engine() % 19) / 2 - 4.5;
    return coordinates;
}

std::vector<RankRange> turned(int num_parts) {
    std::vector<RankRange> ranks;
    for (Part part = 0; part < num_parts; ++part)
        ranks.push_back(
            {(ranks_of_part(part, num_parts, num_ranks()).first_rank + 1) % num_ranks(), 1});
    return ranks;
}

TEST(SpreadGhosts, in_a_periodic_box_are_those_by_the_whole_tree) {
    const std::vector<double> coordinates = positions_here(2);
    const Points points = interleaved_points(coordinates, 2);
    const Cuts whole = random_cuts(2, num_ranks() + 1);
    const GhostOptions options{2, {}, Box{{-5, -5, 0}, {5, 5, 0}}, {}};
    const GhostPlan expected = ghosts(whole, points, options, MPI_COMM_WORLD);
    const GhostPlan found = ghosts(known_here(whole), points, options, MPI_COMM_WORLD);
    EXPECT_EQ(found.send_indices, expected.send_indices);
    EXPECT_EQ(found.shifts, expected.shifts);
    expect_same(found.send, expected.send);
    expect_same(found.receive, expected.receive);
}

TEST(SpreadGhosts, are_those_by_the_whole_tree) {
    for (const int dimension : {1, 2, 3}) {
        const std::vector<double> coordinates = positions_here(dimension);
        const Points points = interleaved_points(coordinates, dimension);
        for (const int num_parts : {2, (num_ranks() + 1) / 2 + 1, num_ranks() + 1, 300}) {
            SCOPED_TRACE(num_parts);
            const Cuts whole = random_cuts(dimension, num_parts);
            for (const double radius : {0.0, 0.5, 2.0, 100.0}) {
                expect_same_plans(whole, known_here(whole), points, radius);
                expect_same_plans(whole, known_here(whole), points, radius, turned(num_parts));
                expect_same_plans(whole, known_here(whole, {0, num_parts / 2}), points, radius);
            }
        }
    }
}

TEST(SpreadGhosts, by_the_radii_of_receivers_are_those_by_the_whole_tree) {
    const std::vector<double> coordinates = positions_here(2);
    const Points points = interleaved_points(coordinates, 2);
    std::vector<double> radii(points.count);
    for (std::size_t i = 0; i < radii.size(); ++i) radii[i] = i % 9 == 0 ? 3 : 0.3;
    for (const int num_parts : {2, num_ranks() + 1, 300}) {
        const Cuts whole = random_cuts(2, num_parts);
        const GhostOptions options{.radii = radii, .needs = Needs::either};
        const GhostPlan expected = ghosts(whole, points, options, MPI_COMM_WORLD);
        const GhostPlan found = ghosts(known_here(whole), points, options, MPI_COMM_WORLD);
        EXPECT_EQ(found.send_indices, expected.send_indices);
        expect_same(found.receive, expected.receive);
    }
}

TEST(SpreadGhosts, need_cuts_of_all_tiers_of_a_tree) {
    const int num_parts = 40000;
    const Cuts whole = test::planes(num_parts);
    // On both ends of the parts of this rank, and anywhere.
    std::mt19937_64 engine(static_cast<unsigned>(rank()));
    std::vector<double> x{1.0 * num_parts * rank() / num_ranks(),
                          1.0 * num_parts * (rank() + 1) / num_ranks()};
    for (int i = 0; i < 20; ++i) x.push_back(test::uniform(engine, 0, num_parts));
    for (const double radius : {0.0, 3.0, 500.0})
        expect_same_plans(whole, known_here(whole), interleaved_points(x, 1), radius);
}

TEST(SpreadGhosts, of_points_on_the_ranks_of_their_parts_are_those_by_the_whole_tree) {
    if (num_ranks() < 3) GTEST_SKIP() << "many ranks make parts where there are more than two";
    const std::vector<double> scattered =
        test::uniform_cloud(400, 2, static_cast<unsigned>(rank() + 1));
    Options options;
    options.num_parts = 2 * num_ranks() + 1;
    options.tuning.central_parts = 2;
    options.cuts = HeldCuts::own;
    const Balance balance =
        rrcb::balance(interleaved_points(scattered, 2), options, MPI_COMM_WORLD);
    const Plan lists = plan(balance.parts, options.num_parts, MPI_COMM_WORLD);
    const auto here = transfer(lists, column(scattered, 2), MPI_COMM_WORLD);
    const Points points = interleaved_points(here, 2);
    const Cuts whole = gather_cuts(balance.cuts, MPI_COMM_WORLD);
    ASSERT_FALSE(is_whole(balance.cuts));
    // Cuts that the rank had above scattered points, and those above its own parts alone.
    std::size_t num_sent = 0;
    for (const Cuts& known : {balance.cuts, known_here(whole)})
        for (const double radius : {0.0, 0.01, 0.1, 2.0}) {
            num_sent += expect_same_plans(whole, known, points, radius);
            const GhostPlan found = ghosts_of(known, points, radius, std::nullopt);
            EXPECT_EQ(verify(found, points, {}, MPI_COMM_WORLD).num_faults, 0);
        }
    EXPECT_GT(num_sent, 100u);
}

/// The Error that a call throws on every rank.
std::string refusal(const Cuts& cuts) {
    const std::vector<double> coordinates{0.5, 0.5};
    try {
        ghosts(cuts, interleaved_points(coordinates, 2), {.radius = 1}, MPI_COMM_WORLD);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
        return error.what();
    }
    return {};
}

TEST(SpreadGhosts, by_cuts_that_do_not_fit_together_are_refused_on_all_ranks) {
    const Cuts whole = random_cuts(2, 3 * num_ranks());
    const Cuts known = known_here(whole);
    Cuts less = known;
    if (test::is_last_rank()) {
        less.tree.pop_back();
        less.nodes.pop_back();
    }
    EXPECT_NE(refusal(less).find("a cut is missing that this rank should know"), std::string::npos);
    EXPECT_TRUE(refusal(known).empty());
    if (num_ranks() == 1) return;
    EXPECT_NE(refusal(test::is_last_rank() ? whole : known).find("the tree of cuts differs"),
              std::string::npos);
    EXPECT_NE(refusal(rank() == 0 ? whole : known).find("the tree of cuts differs"),
              std::string::npos);
    EXPECT_TRUE(refusal(known).empty());
}

}  // namespace
}  // namespace rrcb
