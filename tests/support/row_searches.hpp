// The search for cuts of rows of points, by many ranks in one process.
#pragma once

#include "all_collected.hpp"
#include "bisection/bisection.hpp"
#include "cuts/owned_cuts.hpp"
#include "options/allowed_axes.hpp"
#include "row_cases.hpp"
#include "search/doubles.hpp"
#include "search/tree_search.hpp"
#include "virtual_owners.hpp"

#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <vector>

namespace rrcb::test {

/// Watches the records of all rounds: no number is NaN, and no axis is counted too often.
class RecordWatch {
  public:
    static constexpr int most_counts = 13;

    void observe(const std::vector<Butterfly>& butterflies) {
        for (const Butterfly& one : butterflies) {
            if (!are_answered_)
                one.owned().for_each([&](const Record& record) { note_question(record); });
            if (are_answered_)
                one.answers().for_each([&](const Record& record) { note_answer(record); });
        }
        are_answered_ = !are_answered_;
    }

    const std::set<int>& stages() const { return stages_; }
    int highest_count() const { return highest_count_; }

  private:
    struct Watched {
        CutSearch search{};
        std::array<int, max_dimension> counts{};  ///< along each of its axes
    };

    static void expect_numbers(std::span<const double> numbers) {
        EXPECT_TRUE(std::ranges::none_of(numbers, [](double x) { return std::isnan(x); }));
    }

    void note_question(const Record& record) {
        expect_numbers(record.payload);
        constexpr double mark_of_histogram = 0;
        if (record.payload.empty() || record.payload[0] != mark_of_histogram) return;
        Watched& node = nodes_[record.key];
        const int count = ++node.counts[static_cast<std::size_t>(node.search.tied)];
        highest_count_ = std::max(highest_count_, count);
        EXPECT_LE(count, most_counts) << "counts of one axis";
    }

    void note_answer(const Record& record) {
        const auto search = read<CutSearch>(record.payload);
        expect_numbers(search.cut.at);
        expect_numbers(
            std::array{search.lower, search.upper, search.found_below, search.lot_below});
        expect_numbers(record.payload.subspan(sizeof search / sizeof(double)));
        Watched& node = nodes_[record.key];
        // It begins again if another axis turned out to be the longest.
        if (search.stage == CutSearch::over_points) node.counts = {};
        node.search = search;
        stages_.insert(search.stage);
    }

    bool are_answered_ = false;
    std::map<Key, Watched> nodes_;
    std::set<int> stages_;
    int highest_count_ = 0;
};

/// The ranks of a case. No rank calls MPI.
class RowSearches {
  public:
    explicit RowSearches(const RowCase& one) : case_(one) {
        for (const auto& rows : one.rows) {
            RowPasses& passes = passes_.emplace_back(rows, one.dimension);
            passes.use_weights(!one.has_equal_weights);
            const PointSummary& summary = summaries_.emplace_back(passes.summary(true));
            total_ += summary.weight;
            heaviest_ = std::max(heaviest_, summary.heaviest);
            for (std::size_t a = 0; a < max_dimension; ++a) {
                box_.lower[a] = std::min(box_.lower[a], summary.box.lower[a]);
                box_.upper[a] = std::max(box_.upper[a], summary.box.upper[a]);
            }
        }
        here_.resize(passes_.size());
        sums_.resize(passes_.size());
        if (one.start != Start::nothing) make_guide();
    }

    /// Takes the cuts that rank 0 starts from, and where it expects them to end.
    void start_from(const Cuts& cuts, std::vector<Bracket> brackets) {
        cuts_.assign(passes_.size(), cuts);
        brackets_ = std::move(brackets);
    }

    /// Searches once, from the latest cuts.
    void search(bool is_exact) {
        RecordWatch watch;
        searches_.clear();
        known_.clear();
        const PartTree tree = tree_of(is_exact);
        if (is_central()) count_by_cuts();
        std::deque<Guide> guides;
        std::vector<std::vector<Bracket>> intervals(passes_.size());
        std::vector<OpenMemory> memory(passes_.size());
        std::vector<std::unique_ptr<OpenPoints>> opened;
        for (std::size_t rank = 0; rank < passes_.size(); ++rank) {
            if (is_central()) {
                Guide& guide = guides.emplace_back(Guide{
                    cuts_[rank], brackets_, nullptr, sums_[rank], !is_exact, summaries_[rank].box});
                guide.brackets = intervals[rank] = likely_intervals(tree.rule, guide);
                opened.push_back(
                    open_points(passes_[rank], guide.cuts, guide.brackets, true, memory[rank]));
            } else {
                opened.push_back(all_open(passes_[rank], case_.num_parts, case_.shape));
            }
            searches_.push_back(
                std::make_unique<TreeSearch>(tree, static_cast<int>(rank), *opened.back(),
                                             is_central() ? &guides.back() : nullptr));
        }
        run_searches(searches_, is_central() ? Butterfly::Way::central : Butterfly::Way::spread,
                     [&](const auto& butterflies) { watch.observe(butterflies); });
        for (std::size_t rank = 0; rank < passes_.size(); ++rank)
            here_[rank] = opened[rank]->settle();
        note_cuts();
        stages_.insert(watch.stages().begin(), watch.stages().end());
        highest_count_ = std::max(highest_count_, watch.highest_count());
    }

    /// Returns the cuts of all ranks, by node.
    const std::map<std::size_t, Cut>& cuts() const { return known_; }

    const RowPasses& passes(std::size_t rank) const { return passes_[rank]; }

    /// Returns the weights of all parts.
    std::vector<double> part_weights() const {
        std::vector<double> weights(static_cast<std::size_t>(case_.num_parts));
        for (const RowPasses& one : passes_)
            std::ranges::transform(weights, one.totals(case_.num_parts).weights, weights.begin(),
                                   std::plus<>());
        return weights;
    }

    /// The ranks of a central search know the weights of their points in each part.
    void expect_weights() {
        if (!is_central()) return;
        for (std::size_t rank = 0; rank < passes_.size(); ++rank)
            EXPECT_TRUE(
                std::ranges::equal(passes_[rank].totals(case_.num_parts).weights, here_[rank]))
                << case_;
    }

    const std::set<int>& stages() const { return stages_; }
    int highest_count() const { return highest_count_; }
    int num_collections() const {
        int sum = 0;
        for (const RowPasses& one : passes_) sum += one.num_collections();
        return sum;
    }

  private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    bool is_central() const { return !cuts_.empty(); }

    PartTree tree_of(bool is_exact) const {
        PartTree tree;
        tree.dimension = case_.dimension;
        tree.box = box_;
        tree.num_parts = case_.num_parts;
        tree.num_owners = is_central() ? 1 : case_.num_ranks;
        tree.shape = case_.shape;
        tree.axes = first_axes(case_.dimension);
        tree.weight = total_;
        tree.rule.part_sizes = case_.part_sizes;
        tree.rule.tolerance = case_.tolerance;
        tree.rule.common_weight = case_.has_equal_weights ? 1 : 0;
        tree.rule.heaviest = heaviest_;
        tree.rule.weight_per_size = total_ / sum_of(case_.part_sizes);
        tree.rule.counted_weight = total_;
        tree.rule.is_exact = is_exact;
        tree.plain_cuts = case_.plain_cuts;
        tree.centres_cuts = is_exact;
        tree.divides_coincident = case_.divides_coincident;
        return tree;
    }

    static double sum_of(std::span<const double> numbers) {
        return std::accumulate(numbers.begin(), numbers.end(), 0.0);
    }

    /// Bisects the densities of all cells, as rank 0 does.
    void make_guide() {
        std::vector<CellMoments> cells;
        std::mt19937_64 random(case_.seed);
        const int layers = 1 + static_cast<int>(uniform(random, 0, 6));
        for (std::size_t rank = 0; rank < passes_.size(); ++rank) {
            if (passes_[rank].count() == 0) continue;
            const SupportMesh mesh =
                make_support_mesh(summaries_[rank].box, case_.dimension, layers);
            const auto here = passes_[rank].moments(mesh);
            cells.insert(cells.end(), here.begin(), here.end());
        }
        Options options;
        options.num_parts = case_.num_parts;
        options.part_sizes = case_.part_sizes;
        options.expert.axes.plain = case_.plain_cuts;
        options.expert.tree = case_.shape;
        Bisection made = bisect(analytic_domain(cells, case_.dimension, box_), options, true);
        if (case_.start != Start::estimate) move(made, random);
        start_from(made.cuts, std::move(made.brackets));
    }

    /// Moves cuts a little or much, also off all points.
    void move(Bisection& made, std::mt19937_64& random) const {
        const double reach = std::pow(10, -3 * uniform(random));
        for (std::size_t k = 0; k < made.cuts.tree.size(); ++k) {
            const auto axis = static_cast<std::size_t>(made.cuts.tree[k].axis);
            double& value = made.cuts.tree[k].at[axis];
            if (!std::isfinite(value)) continue;
            const double half = box_.upper[axis] / 2 - box_.lower[axis] / 2;
            value += uniform(random, -reach, reach) * half;
            made.brackets[k] = {value - half * reach / 8, value + half * reach / 8};
        }
    }

    /// Gives the points the parts of the latest cuts, and adds up the weights of these.
    void count_by_cuts() {
        std::vector<double> all(static_cast<std::size_t>(case_.num_parts));
        for (std::size_t rank = 0; rank < passes_.size(); ++rank) {
            here_[rank] = passes_[rank].assign(cuts_[rank], true).weights;
            std::ranges::transform(all, here_[rank], all.begin(), std::plus<>());
        }
        sums_.assign(passes_.size(), all);
    }

    void note_cuts() {
        for (std::size_t rank = 0; rank < searches_.size(); ++rank) {
            const Cuts cuts = is_central() ? cuts_[rank] : searches_[rank]->own_cuts();
            for (std::size_t k = 0; k < cuts.tree.size(); ++k) {
                const int owner = owner_of(node_at(cuts, k), case_.num_parts, case_.num_ranks);
                if (!is_central() && owner != static_cast<int>(rank)) continue;
                const Cut& cut = known_.emplace(k, cuts.tree[k]).first->second;
                EXPECT_TRUE(cut.axis == cuts.tree[k].axis && cut.at == cuts.tree[k].at &&
                            cut.divides == cuts.tree[k].divides)
                    << "ranks differ, " << case_;
            }
        }
    }

    const RowCase& case_;
    std::deque<RowPasses> passes_;
    std::vector<PointSummary> summaries_;
    double total_ = 0;
    double heaviest_ = 0;
    Box box_;
    std::vector<Cuts> cuts_;  ///< of each rank
    std::vector<Bracket> brackets_;
    std::vector<std::vector<double>> here_;  ///< weights of a rank's points in the parts
    std::vector<std::vector<double>> sums_;  ///< and of all points, as each rank knows them
    std::vector<std::unique_ptr<TreeSearch>> searches_;
    std::map<std::size_t, Cut> known_;
    std::set<int> stages_;
    int highest_count_ = 0;
};

}  // namespace rrcb::test
