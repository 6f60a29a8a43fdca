// The whole search for cuts on random trees, of points that exist as numbers only and without MPI.
#include "../support/row_cases.hpp"
#include "../support/row_reference.hpp"
#include "../support/row_searches.hpp"

#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace rrcb {
namespace {

using test::Row;
using test::RowCase;
using test::RowCases;
using test::RowReference;
using test::RowSearches;

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(RowSearch, finds_the_cuts_of_a_sort_on_thousands_of_random_trees) {
    constexpr unsigned num_trees = 3000;
    std::set<int> stages;
    int highest_count = 0;
    int num_collections = 0;
    for (unsigned seed = 1; seed <= num_trees && !testing::Test::HasFailure(); ++seed) {
        const RowCase one = RowCases(seed).make();
        RowSearches ranks(one);
        ranks.search(one.is_exact);
        bool is_exact = one.is_exact;
        if (!is_exact) {
            const RowReference reference(one, ranks);
            const std::vector<double> weights = ranks.part_weights();
            reference.expect_tolerance(weights);
            is_exact = imbalance(weights, one.part_sizes) > one.tolerance ||
                       reference.leaves_parts_empty(weights);
            if (is_exact) ranks.search(true);
        }
        if (is_exact) RowReference(one, ranks).expect_exact();
        ranks.expect_weights();
        stages.insert(ranks.stages().begin(), ranks.stages().end());
        highest_count = std::max(highest_count, ranks.highest_count());
        num_collections += ranks.num_collections();
    }
    EXPECT_EQ(stages.size(), 6U) << "all stages of a search";
    EXPECT_GT(num_collections, 0) << "of cuts that left their intervals";
    RecordProperty("highest_count", highest_count);
}

/// Cuts of points at 0, 1, ... `total` - 1 that leave each part its share, but for a few points.
void add_cuts(const Descent& at, double total, Cuts& cuts, std::vector<Bracket>& brackets) {
    if (at.is_part()) return;
    const double off = std::round(50 * std::cos(static_cast<double>(at.node)));
    const double value = total / cuts.num_parts * at.upper().first_part + off;
    cuts.tree.push_back({.at = {value, -infinity, -infinity}});
    brackets.push_back({value - 100, value + 100});
    add_cuts(at.lower(), total, cuts, brackets);
    add_cuts(at.upper(), total, cuts, brackets);
}

TEST(RowSearch, divides_a_trillion_points_of_which_it_collects_few) {
    constexpr LocalIndex per_rank = LocalIndex{1} << 37;
    constexpr double total = 8.0 * per_rank;
    for (const int num_parts : {2, 7, 100}) {
        RowCase one{.num_ranks = 8, .num_parts = num_parts};
        one.has_equal_weights = true;
        one.part_sizes.assign(static_cast<std::size_t>(num_parts), 1);
        for (int rank = 0; rank < one.num_ranks; ++rank)
            one.rows.push_back({Row{.first = {rank * 0x1p37}, .step = 1, .count = per_rank}});
        Cuts cuts{1, num_parts, {}};
        std::vector<Bracket> brackets;
        add_cuts({0, 0, num_parts}, total, cuts, brackets);
        RowSearches ranks(one);
        ranks.start_from(cuts, brackets);
        ranks.search(true);
        for (const double weight : ranks.part_weights())
            EXPECT_LE(std::abs(weight - total / num_parts), 1) << num_parts << " parts";
        ranks.expect_weights();
    }
}

}  // namespace
}  // namespace rrcb
