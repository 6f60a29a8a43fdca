// The search of paths by many ranks in one process.
#include "../support/clouds.hpp"
#include "../support/virtual_butterfly.hpp"
#include "lists/tier_search.hpp"
#include "passes/assignment.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Planes at 1, 2, ... in one dimension: the part of a position is what is before its point. Keeps
/// the nodes of `depth` levels at the top, and those above parts from `first` to `last` - 1.
void add_planes(const Descent& at, int depth, Part first, Part last, Cuts& cuts) {
    const bool is_above = at.first_part < last && first < at.first_part + at.num_parts;
    if (at.is_part() || (depth <= 0 && !is_above)) return;
    cuts.nodes.push_back(static_cast<std::int32_t>(at.node));
    cuts.tree.push_back({0, 0, {static_cast<double>(at.upper().first_part), -infinity, -infinity}});
    add_planes(at.lower(), depth - 1, first, last, cuts);
    add_planes(at.upper(), depth - 1, first, last, cuts);
}

/// One of the ranks, with positions anywhere.
struct VirtualRank {
    Cuts known;
    std::vector<double> x;
    Points points{};
    std::vector<Part> parts{};

    VirtualRank(int rank, int num_ranks, int num_parts, std::size_t num_points)
        : known{1, num_parts, {}} {
        const int share = num_parts / num_ranks;
        add_planes(root_of(known), 6, rank * share, (rank + 1) * share, known);
        std::mt19937_64 engine(static_cast<unsigned>(rank));
        for (std::size_t i = 0; i < num_points; ++i)
            x.push_back(test::uniform(engine, 0, num_parts));
    }
};

class ManyRanks : public testing::Test {
  protected:
    void add_ranks(int num_ranks, int num_parts, std::size_t num_points) {
        ranks.reserve(static_cast<std::size_t>(num_ranks));
        for (int rank = 0; rank < num_ranks; ++rank) {
            VirtualRank& one = ranks.emplace_back(rank, num_ranks, num_parts, num_points);
            one.points = interleaved_points(one.x, 1);
            one.parts.resize(num_points);
            assign_known(one.known, one.points, one.parts);
            searches.emplace_back(one.known, one.points, one.parts);
            shared.emplace_back(rank, num_ranks, PathSearch::join_cuts);
            asked.emplace_back(rank, num_ranks, PathSearch::join_questions);
        }
        flags.resize(ranks.size());
    }

    test::PassCounts run(std::vector<Butterfly>& all, Butterfly::Direction direction) {
        return test::run_pass(all, direction, flags, [](int, int) { return false; });
    }

    void share() {
        for (std::size_t k = 0; k < ranks.size(); ++k) searches[k].share(shared[k]);
        shared_counts = run(shared, Butterfly::to_owners);
    }

    /// Whether any rank asked.
    bool ask_and_learn() {
        bool asks = false;
        for (std::size_t k = 0; k < ranks.size(); ++k) {
            asked[k].clear();
            asks = searches[k].ask(asked[k]) || asks;
        }
        run(asked, Butterfly::to_owners);
        for (std::size_t k = 0; k < ranks.size(); ++k) searches[k].answer(shared[k], asked[k]);
        run(asked, Butterfly::back);
        for (std::size_t k = 0; k < ranks.size(); ++k) searches[k].learn(asked[k]);
        return asks;
    }

    void expect_all_found() const {
        for (const VirtualRank& one : ranks)
            for (std::size_t i = 0; i < one.x.size(); ++i)
                ASSERT_EQ(one.parts[i], static_cast<Part>(one.x[i]));
    }

    std::vector<VirtualRank> ranks;
    std::vector<PathSearch> searches;
    std::vector<Butterfly> shared;
    std::vector<Butterfly> asked;
    std::vector<Flags> flags;
    test::PassCounts shared_counts;
};

TEST_F(ManyRanks, find_parts_among_a_million_by_two_questions) {
    add_ranks(2048, 1 << 20, 3);
    share();
    int num_questions = 0;
    while (ask_and_learn()) ++num_questions;
    EXPECT_EQ(num_questions, 2);
    expect_all_found();
    // 512 parts a rank: what it owns, and as much again of others on their way.
    EXPECT_LE(shared_counts.longest, 64000u);
    RecordProperty("longest_shared", static_cast<int>(shared_counts.longest));
    RecordProperty("most_bytes_in", static_cast<int>(shared_counts.most_bytes_in));
}

TEST_F(ManyRanks, that_know_all_they_need_ask_nothing) {
    add_ranks(5, 100, 0);
    share();
    EXPECT_FALSE(ask_and_learn());
}

}  // namespace
}  // namespace rrcb
