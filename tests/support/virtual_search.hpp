// The search for cuts on a great many virtual ranks, in one process.
#pragma once

#include "all_collected.hpp"
#include "arithmetic/non_stop.hpp"
#include "estimate/contribution.hpp"
#include "memory_layer.hpp"
#include "options/allowed_axes.hpp"
#include "passes/host_passes.hpp"
#include "search/tree_search.hpp"
#include "virtual_cloud.hpp"
#include "virtual_round.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rrcb::test {

/// What a search amounted to; sizes in bytes.
struct SearchTotals {
    int rounds = 0;
    MessageTotals messages{};
    std::int64_t bytes_in_a_row = 0;  ///< of the longest message of every step of every round
    std::size_t most_into_rank = 0;   ///< in one round
    std::int64_t most_memory = 0;     ///< of a rank, beside its points

    std::size_t longest() const {
        std::size_t longest = 0;
        for (const auto& ways : messages.longest) longest = std::max({longest, ways[0], ways[1]});
        return longest;
    }
};

/// Ranks of a cloud, a part each, that search for the cuts of all points.
class VirtualSearch {
  public:
    VirtualSearch(const VirtualCloud& cloud, double tolerance)
        : parts_(cloud.coordinates.size() / 2),
          ranks_(static_cast<std::size_t>(cloud.num_ranks())),
          memory_(ranks_.size(), Memory{sizeof(Rank), sizeof(Rank)}) {
        const PartTree tree = tree_of(cloud, tolerance);
        for (int rank = 0; rank < cloud.num_ranks(); ++rank) start(cloud, tree, rank);
    }

    int num_ranks() const { return static_cast<int>(ranks_.size()); }
    Butterfly& butterfly(int rank) { return of(rank).butterfly; }

    /// Runs a step of a rank, and notes what memory that takes.
    template <class Step>
    void run(int rank, Step&& step) {
        Memory& memory = memory_[static_cast<std::size_t>(rank)];
        const std::int64_t before = memory_layer::live_bytes();
        memory_layer::restart_peak();
        step();
        memory.most = std::max(memory.most, memory.now + memory_layer::peak_bytes());
        memory.now += memory_layer::live_bytes() - before;
    }

    void turn(int rank) {
        of(rank).search.decide(butterfly(rank));
        butterfly(rank).start(butterfly(rank).flags());
    }

    /// Searches until no rank does, which the flags tell all of them in one more round.
    SearchTotals search() {
        SearchTotals totals;
        for (bool goes_on = true; goes_on;) {
            run_all([&](int rank) { ask(rank); });
            const VirtualRound<VirtualSearch> round(*this);
            goes_on = butterfly(0).flags()[1] > 0;
            if (goes_on) note(round, totals);
            run_all([&](int rank) { of(rank).search.follow(butterfly(rank)); });
        }
        auto next = parts_.begin();
        for (auto& rank : ranks_) {
            rank->open->settle();
            next = std::ranges::copy(rank->passes.parts_here(), next).out;
        }
        for (const Memory& memory : memory_)
            totals.most_memory = std::max(totals.most_memory, memory.most);
        return totals;
    }

    /// Of each point.
    std::span<const Part> parts() const { return parts_; }

    /// The largest that a rank tells of its part.
    double imbalance() const {
        double largest = 0;
        for (const auto& rank : ranks_) largest = std::max(largest, rank->search.imbalance());
        return largest;
    }

  private:
    struct Rank {
        HostPasses passes;
        OpenMemory memory;
        std::unique_ptr<OpenPoints> open;
        TreeSearch search;
        Butterfly butterfly;

        Rank(const PartTree& tree, int rank, const Points& points)
            : passes(points, std::vector<Part>(points.count)),
              open(open_points(passes, {2, tree.num_parts, {}}, {}, false, memory)),
              search(tree, rank, *open),
              butterfly(rank, tree.num_owners, TreeSearch::join) {}
    };
    struct Memory {
        std::int64_t now;
        std::int64_t most;
    };

    template <class Step>
    void run_all(Step&& step) {
        by_halves(0, num_ranks(), [&](int begin, int end) {
            for (int rank = begin; rank < end; ++rank) run(rank, [&] { step(rank); });
            return MessageTotals{};
        });
    }

    Rank& of(int rank) { return *ranks_[static_cast<std::size_t>(rank)]; }

    PartTree tree_of(const VirtualCloud& cloud, double tolerance) const {
        PartTree tree;
        tree.dimension = 2;
        tree.box = bounding_box(cloud.points());
        tree.num_parts = tree.num_owners = cloud.num_ranks();
        tree.weight = static_cast<double>(parts_.size());
        tree.axes = first_axes(2);
        tree.rule.weight_per_size = tree.weight / tree.num_parts;
        tree.rule.tolerance = tolerance;
        tree.rule.is_exact = !(tolerance > 1);
        tree.rule.common_weight = tree.rule.heaviest = 1;
        return tree;
    }

    void start(const VirtualCloud& cloud, const PartTree& tree, int rank) {
        const Points mine = cloud.points_of(rank);
        run(rank, [&] { ranks_[static_cast<std::size_t>(rank)].emplace(tree, rank, mine); });
    }

    void ask(int rank) {
        butterfly(rank).clear();
        of(rank).search.ask(butterfly(rank));
        butterfly(rank).start({0, of(rank).search.is_searching() ? 1.0 : 0.0});
    }

    static void note(const VirtualRound<VirtualSearch>& round, SearchTotals& totals) {
        ++totals.rounds;
        totals.messages.join(round.totals());
        for (const auto& ways : round.totals().longest)
            totals.bytes_in_a_row += static_cast<std::int64_t>(ways[0] + ways[1]);
        totals.most_into_rank =
            std::max(totals.most_into_rank, *std::ranges::max_element(round.bytes_into()));
    }

    NonStop arithmetic_;  // as in a call
    std::vector<Part> parts_;
    std::vector<std::optional<Rank>> ranks_;
    std::vector<Memory> memory_;
};

}  // namespace rrcb::test
