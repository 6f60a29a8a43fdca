// The checker itself: a property that is false on one rank alone is found false, and shrunk.
#include "../support/ranks.hpp"
#include "check_mpi.hpp"

#include <gtest/gtest.h>

namespace rrcb::test {
namespace {

TEST(Check, finds_and_shrinks_what_fails_on_the_last_rank_alone) {
    int num_judged = 0;
    const Verdict verdict = find_counterexample(
        "fewer than three points",
        [&](const Case& input) -> std::string {
            ++num_judged;
            return input.seeds.size() >= 3 && is_last_rank() ? "too many" : "";
        },
        100);
    int most = num_judged;
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_EQ(num_judged, most);
    if (rank() != 0) return;
    EXPECT_EQ(verdict.smallest.seeds.size(), 3u);
    EXPECT_NE(verdict.text.find("rank " + std::to_string(num_ranks() - 1) + ": too many"),
              std::string::npos)
        << verdict.text;
    EXPECT_NE(verdict.text.find("seed "), std::string::npos);
}

TEST(Check, takes_what_is_thrown_for_a_failure) {
    const Verdict verdict = find_counterexample(
        "never thrown", [](const Case&) -> std::string { throw std::runtime_error("no"); }, 10);
    EXPECT_EQ(verdict.text.empty(), rank() != 0);
}

TEST(Check, lets_pass_what_holds) {
    EXPECT_TRUE(find_counterexample(
                    "holds", [](const Case&) { return ""; }, 20)
                    .text.empty());
}

TEST(Check, generates_points_of_every_owner_and_coordinates_that_are_finite) {
    std::vector<LocalIndex> held(static_cast<std::size_t>(num_ranks()));
    find_counterexample(
        "looks",
        [&](const Case& input) -> std::string {
            const Cloud cloud = cloud_of(input, num_ranks());
            for (const int owner : cloud.owners) ++held.at(static_cast<std::size_t>(owner));
            const Box box = bounding_box(cloud.points());
            for (std::size_t a = 0; a < static_cast<std::size_t>(cloud.dimension); ++a)
                if (cloud.size() > 0 && !(box.lower[a] <= box.upper[a])) return "not finite";
            return cloud.of_rank(rank()).size() == cloud.held_by(rank()).size() ? "" : "lost";
        },
        100);
    for (const LocalIndex count : held) EXPECT_GT(count, 0u);
}

}  // namespace
}  // namespace rrcb::test
