// Many sub-domains in one process, through the code that ranks run: each makes its contribution,
// the contributions merge up the tree of so many ranks, the root bisects what arrives, and the cuts
// are refined by what all sub-domains hold.
#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "estimate/decision_mpi.hpp"
#include "options/validation.hpp"
#include "passes/host_passes.hpp"
#include "search/settlement_mpi.hpp"

#include <rrcb/quality.hpp>

namespace rrcb {
namespace {

constexpr std::size_t points_per_rank = 16;

/// A square lattice of sub-domains, each with its points spread evenly over a unit square.
struct VirtualRanks {
    int side;
    Options options;
    std::vector<double> coordinates{};
    std::size_t longest_message = 0;  ///< in doubles
    std::size_t root_in = 0;          ///< doubles that rank 0 received

    explicit VirtualRanks(int ranks_per_side) : side(ranks_per_side) {
        options.num_parts = num_ranks();
        options.part_sizes.assign(static_cast<std::size_t>(num_ranks()), 1.0);
        options.refine = Refine::tolerance;
        coordinates =
            test::uniform_cloud(points_per_rank * static_cast<std::size_t>(num_ranks()), 2, 1);
        for (std::size_t i = 0; i < coordinates.size(); i += 2) {
            const auto rank = static_cast<int>(i / (2 * points_per_rank));
            coordinates[i] += rank % side;
            coordinates[i + 1] += rank / side;
        }
    }

    int num_ranks() const { return side * side; }

    Points points() const { return Points(coordinates, 2); }

    Points points_of(int rank) const {
        return Points(
            std::span(coordinates)
                .subspan(2 * points_per_rank * static_cast<std::size_t>(rank), 2 * points_per_rank),
            2);
    }

    /// What a rank sends to its parent.
    Contribution contribution_of(int rank) {
        HostPasses mine(points_of(rank));
        const PointSummary summary = mine.summary(true);
        Contribution all{summarize(summary, false, 0), {}};
        add_records(mine, summary.box, num_ranks(), options, all);
        all.summary.first_rank = rank;
        MergeTree{num_ranks()}.for_each_child(rank, [&](int child) {
            const Contribution theirs = contribution_of(child);
            const std::size_t length = theirs.records.size();
            longest_message = std::max(longest_message, length);
            root_in += rank == 0 ? length : 0;
            absorb(all, theirs.summary, theirs.records, 2, most_cells(options));
        });
        return all;
    }
};

class ManyRanks : public testing::TestWithParam<int> {};

TEST_P(ManyRanks, send_the_root_a_bounded_number_of_cells_and_are_balanced_all_the_same) {
    VirtualRanks ranks(GetParam());
    const Contribution all = ranks.contribution_of(0);
    const std::size_t most = most_cells(ranks.options);
    const std::size_t doubles_per_cell = 3 + 2 * 2;
    EXPECT_LE(all.summary.num_cells, static_cast<std::int64_t>(2 * most));
    EXPECT_LE(ranks.longest_message, most * doubles_per_cell + 100);
    // Seven children in each of the six levels that the tree of 8^6 ranks has.
    EXPECT_LE(ranks.root_in, 6 * 7 * most * doubles_per_cell);

    Participant self{MPI_COMM_SELF};
    HostPasses passes(ranks.points());
    const Box box = passes.summary(true).box;
    Decision decision;
    make_buffers(decision, ranks.options, 2, false);
    decide(all, ranks.options, decision);
    const Verdict& verdict = decision.verdict;
    OpenMemory memory;
    Settlement settlement(ranks.options, passes, false, memory, self);
    const SettledCuts made =
        settlement.run({verdict.num_points, verdict.balanced_weight(), 1, true, verdict.box}, box,
                       false, {std::move(decision.cuts), std::move(decision.brackets)}, self);

    std::vector<double> weights(ranks.options.part_sizes.size());
    for (const Part part : passes.parts_here()) weights[static_cast<std::size_t>(part)] += 1;
    EXPECT_LE(imbalance(weights, ranks.options.part_sizes), 1.01);
    EXPECT_EQ(imbalance(weights, ranks.options.part_sizes), made.imbalance);
    RecordProperty("rounds", made.rounds);
    RecordProperty("cells", static_cast<int>(all.summary.num_cells));
    RecordProperty("root_kilobytes", static_cast<int>(ranks.root_in * sizeof(double) / 1000));
    RecordProperty("longest_message_kilobytes",
                   static_cast<int>(ranks.longest_message * sizeof(double) / 1000));
}

INSTANTIATE_TEST_SUITE_P(From16To65536, ManyRanks, testing::Values(4, 16, 64, 256));

}  // namespace
}  // namespace rrcb
