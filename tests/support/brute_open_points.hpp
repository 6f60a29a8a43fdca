// Open points that stay where they are: each answer reads every point by itself.
#pragma once

#include "cuts/tree.hpp"
#include "passes/open_points.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace rrcb::test {

class BruteOpenPoints final : public OpenPoints {
  public:
    /// Writes the parts into `parts` at last, and counts the positions that leave in `num_taken`.
    /// Borrows the cuts.
    BruteOpenPoints(const Points& points, const Cuts& cuts, std::span<const Bracket> intervals,
                    std::vector<Part>& parts, std::size_t& num_taken)
        : points_(points),
          cuts_(cuts),
          intervals_(intervals.begin(), intervals.end()),
          parts_(parts),
          num_taken_(num_taken) {
        for (LocalIndex i = 0; i < points.count; ++i)
            states_.push_back({down(i, root_of(cuts)), false});
    }

    bool is_empty(const Descent& at) const override { return waiting(at).empty(); }

    double weight_at(const Descent& at) const override {
        double weight = 0;
        for (const LocalIndex i : waiting(at)) weight += points_.weight(i);
        return weight;
    }

    Total total_in(const Descent& at) const override {
        Total total;
        for (const LocalIndex i : in(at))
            if (has_cuts()) total = total + Total{points_.weight(i), 1};
        return total;
    }

    void count(const Descent& at, int axis, const Bins& bins, const HistogramLayout& layout,
               std::span<double> histogram) const override {
        for (const LocalIndex i : candidates(at))
            for (std::size_t a = 0; a < static_cast<std::size_t>(points_.dimension); ++a) {
                double* const ends = &histogram[a];
                ends[0] = std::max(ends[0], -points_.position(i)[a]);
                ends[max_dimension] = std::max(ends[max_dimension], points_.position(i)[a]);
            }
        count_sums(at, axis, bins, layout, sums_in(histogram));
    }

    void count_sums(const Descent& at, int axis, const Bins& bins, const HistogramLayout& layout,
                    std::span<double> sums) const override {
        for (const LocalIndex i : candidates(at)) {
            const auto slot = static_cast<std::size_t>(bins.slot_of(points_.coordinate(i, axis)));
            if (layout.is_weighted) sums[slot] += points_.weight(i);
            sums.last(layout.num_slots())[slot] += 1;
        }
    }

    void choose(const Descent& at, int axis, const Bracket& interval) override {
        for (const LocalIndex i : candidates(at)) {
            const double x = points_.coordinate(i, axis);
            states_[i].is_refused = x < interval.lower || x >= interval.upper;
        }
    }

    void take(const Descent& at, std::vector<double>& records) const override {
        for (const LocalIndex i : candidates(at)) {
            ++num_taken_;
            for (int a = 0; a < points_.dimension; ++a) records.push_back(points_.coordinate(i, a));
            records.push_back(points_.weight(i));
        }
    }

    PointsInLot lot(const Descent& at, const Cut& cut) const override {
        PointsInLot found;
        for (const LocalIndex i : waiting(at)) {
            const double weight = points_.weight(i);
            if (!is_at(cut, i) || !(weight > 0)) continue;
            if (found.weight == 0) found.first = weight;
            found.before_last = found.weight;
            found.last = weight;
            found.weight += weight;
        }
        return found;
    }

    Gap gap(const Descent& at, const Cut& cut) override {
        Gap gap;
        gap.fill(-infinity);
        for (const LocalIndex i : in(at)) {
            const bool above = is_above(cut, points_.position(i), points_.dimension);
            std::vector<int> axes{cut.axis};
            for (int a = 0; a < points_.dimension; ++a)
                if (a != cut.axis) axes.push_back(a);
            for (std::size_t k = 0; k < axes.size(); ++k) {
                const double x = points_.coordinate(i, axes[k]);
                double& end = gap[2 * k + (above ? 0 : 1)];
                end = std::max(end, above ? -x : x);
                if (x != cut.at[static_cast<std::size_t>(axes[k])]) break;
            }
        }
        return gap;
    }

    void cut(const Descent& at, const Cut& cut, const Lot& lot) override {
        double sum = 0;
        for (const LocalIndex i : waiting(at)) {
            bool above = is_above(cut, points_.position(i), points_.dimension);
            if (lot.below > 0 && is_at(cut, i)) {
                above = lot.is_above(sum, points_.weight(i));
                sum += points_.weight(i);
            }
            states_[i] = {down(i, above ? at.upper() : at.lower()), false};
        }
    }

    void widen(std::span<const WiderNode> nodes) override {
        for (const auto& [at, interval] : nodes) {
            const std::vector<LocalIndex> already = waiting(at);
            intervals_[at.node] = interval;
            for (const LocalIndex i : in(at))
                if (!std::ranges::binary_search(already, i)) states_[i] = {down(i, at), false};
        }
    }

    std::vector<double> settle() override {
        std::vector<double> weights(static_cast<std::size_t>(cuts_.num_parts));
        for (LocalIndex i = 0; i < points_.count; ++i) {
            const Part part = parts_[i] = part_of(i, states_[i].at);
            weights[static_cast<std::size_t>(part)] += points_.weight(i);
        }
        return weights;
    }

  private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    struct State {
        Descent at;       ///< node where the point waits, or its part
        bool is_refused;  ///< no candidate of the node
    };

    bool has_cuts() const { return std::ssize(cuts_.tree) == cuts_.num_parts - 1; }

    bool is_at(const Cut& cut, LocalIndex i) const {
        const Vector x = points_.position(i);
        return std::equal(x.begin(), x.begin() + points_.dimension, cut.at.begin());
    }

    Part part_of(LocalIndex i, Descent at) const {
        while (!at.is_part())
            at = is_above(cuts_.tree[at.node], points_.position(i), points_.dimension) ? at.upper()
                                                                                       : at.lower();
        return at.first_part;
    }

    /// Returns where a point waits from a node on.
    Descent down(LocalIndex i, Descent at) const {
        while (has_cuts() && !at.is_part()) {
            const double x = points_.coordinate(i, cuts_.tree[at.node].axis);
            const Bracket& interval = intervals_[at.node];
            if (x >= interval.lower && x < interval.upper) break;
            at = x < interval.lower ? at.lower() : at.upper();
        }
        return at;
    }

    template <class Test>
    std::vector<LocalIndex> points_with(const Test& test) const {
        std::vector<LocalIndex> found;
        for (LocalIndex i = 0; i < points_.count; ++i)
            if (test(states_[i])) found.push_back(i);
        return found;
    }
    static bool are_same(const Descent& a, const Descent& b) {
        return a.first_part == b.first_part && a.num_parts == b.num_parts;
    }
    std::vector<LocalIndex> waiting(const Descent& at) const {
        return points_with([&](const State& one) { return are_same(one.at, at); });
    }
    std::vector<LocalIndex> candidates(const Descent& at) const {
        return points_with(
            [&](const State& one) { return are_same(one.at, at) && !one.is_refused; });
    }
    std::vector<LocalIndex> in(const Descent& at) const {
        return points_with([&](const State& one) {
            return one.at.first_part >= at.first_part &&
                   one.at.first_part + one.at.num_parts <= at.first_part + at.num_parts;
        });
    }

    Points points_;
    const Cuts& cuts_;
    std::vector<Bracket> intervals_;
    std::vector<Part>& parts_;
    std::size_t& num_taken_;
    std::vector<State> states_;
};

}  // namespace rrcb::test
