// Passes that read each point by itself, as their contract says: for comparison, not for speed.
#pragma once

#include <rrcb/detail/passes.hpp>
#include <rrcb/detail/sample.hpp>
#include <rrcb/error.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace rrcb::test {

class BrutePasses : public PointPasses {
  public:
    BrutePasses(std::span<const double> coordinates, int dimension,
                std::span<const double> weights = {})
        : all_(Points(coordinates, dimension, weights)),
          weights_(weights),
          parts_(all_.count, no_part) {}

    int dimension() const override { return all_.dimension; }
    LocalIndex count() const override { return all_.count; }
    bool has_weights() const override { return !weights_.empty(); }
    void use_weights(bool are_used) override {
        all_.weights = are_used ? weights_ : std::span<const double>{};
    }

    PointSummary summary(bool reads_positions) override {
        PointSummary summary;
        summary.count = all_.count;
        for (LocalIndex i = 0; i < all_.count; ++i) {
            const double weight = all_.weight(i);
            if (!(weight >= 0 && std::isfinite(weight))) fail("weight", i);
            summary.weight += weight;
            summary.lightest = std::min(summary.lightest, weight);
            summary.heaviest = std::max(summary.heaviest, weight);
            if (reads_positions) widen(i, summary);
        }
        return summary;
    }

    int num_moments = 0;  ///< calls of moments()

    PointSample sample(LocalIndex size) override {
        PointSample sample;
        for (LocalIndex k = 0; k < std::min(size, all_.count); ++k) {
            const LocalIndex i = size < all_.count ? detail::sampled(k, all_.count) : k;
            sample.positions.push_back(all_.position(i));
            if (!all_.weights.empty()) sample.weights.push_back(all_.weight(i));
        }
        return sample;
    }

    std::vector<CellMoments> moments(const SupportMesh& mesh) override {
        ++num_moments;
        return cell_moments(all_, mesh);
    }

    PartTotals assign(const Cuts& cuts, bool counts) override {
        for (LocalIndex i = 0; i < all_.count; ++i) {
            check(i);
            parts_[i] = part_of(cuts, all_.position(i));
        }
        return counts ? totals(cuts.num_parts) : PartTotals{};
    }

    void collect(const Cuts& cuts, std::span<const Bracket> intervals, bool has_parts,
                 Collected& collected) override {
        const bool divides =
            std::ranges::any_of(cuts.tree, [](const Cut& c) { return c.divides != 0; });
        collected = {};
        collected.dimension = all_.dimension;
        for (LocalIndex i = 0; i < all_.count; ++i) {
            const Vector x = all_.position(i);
            if (has_parts && !divides && parts_[i] != part_of(cuts, x)) fail("part", i);
            parts_[i] = settled_part(cuts, intervals, x);
            if (parts_[i] == no_part) append(i, collected);
        }
        collected.settled = totals(cuts.num_parts);
    }

    std::vector<std::size_t> collect_more(std::span<const Wanted> wanted,
                                          Collected& collected) override {
        std::vector<std::size_t> found;
        for (LocalIndex i = 0; i < all_.count; ++i)
            for (std::size_t k = 0; k < wanted.size(); ++k) {
                const Wanted& one = wanted[k];
                if (parts_[i] < one.first_part || parts_[i] >= one.first_part + one.num_parts ||
                    !one.contains(all_.coordinate(i, one.axis)))
                    continue;
                parts_[i] = no_part;
                append(i, collected);
                found.push_back(k);
            }
        collected.settled = totals(static_cast<int>(collected.settled.counts.size()));
        return found;
    }

    std::vector<Box> boxes(int num_parts) override {
        std::vector<PointSummary> of_parts(static_cast<std::size_t>(num_parts));
        for (LocalIndex i = 0; i < all_.count; ++i)
            if (parts_[i] != no_part) widen(i, of_parts[static_cast<std::size_t>(parts_[i])]);
        std::vector<Box> boxes;
        for (const PointSummary& one : of_parts) boxes.push_back(one.box);
        return boxes;
    }

    void settle(const Collected& collected, std::span<const Part> parts) override {
        for (LocalIndex k = 0; k < collected.count(); ++k) parts_[collected.original[k]] = parts[k];
    }
    void renumber(std::span<const Part> numbers) override {
        for (Part& part : parts_)
            part = numbers.size() == 1 ? numbers[0] : numbers[static_cast<std::size_t>(part)];
    }
    std::vector<Part> parts() const override { return parts_; }
    void set_parts(std::span<const Part> parts) override {
        parts_.assign(parts.begin(), parts.end());
    }

  private:
    [[noreturn]] static void fail(const std::string& what, LocalIndex i) {
        throw Error(ErrorCode::invalid_argument, what + " of point " + std::to_string(i));
    }

    void check(LocalIndex i) const {
        for (int a = 0; a < all_.dimension; ++a)
            if (!std::isfinite(all_.coordinate(i, a))) fail("coordinate", i);
    }

    void widen(LocalIndex i, PointSummary& summary) const {
        check(i);
        const Vector x = all_.position(i);
        for (std::size_t a = 0; a < static_cast<std::size_t>(all_.dimension); ++a) {
            summary.box.lower[a] = std::min(summary.box.lower[a], x[a]);
            summary.box.upper[a] = std::max(summary.box.upper[a], x[a]);
            const auto order = [a](const Vector& at) {
                return std::tuple(at[a], at[a == 0 ? 1 : 0], at[a == 2 ? 1 : 2]);
            };
            summary.first[a] = std::min(summary.first[a], x, [&](const auto& p, const auto& q) {
                return order(p) < order(q);
            });
            summary.last[a] = std::max(summary.last[a], x, [&](const auto& p, const auto& q) {
                return order(p) < order(q);
            });
        }
    }

    static Part settled_part(const Cuts& cuts, std::span<const Bracket> intervals,
                             const Vector& x) {
        Part first = 0;
        int num_parts = cuts.num_parts;
        for (std::size_t node = 0; num_parts > 1;) {
            const int below = cuts.shape.lower_parts(num_parts);
            const double value = x[static_cast<std::size_t>(cuts.tree[node].axis)];
            if (value < intervals[node].lower) {
                num_parts = below;
                node += 1;
            } else if (value >= intervals[node].upper) {
                first += below;
                num_parts -= below;
                node += static_cast<std::size_t>(below);
            } else {
                return no_part;
            }
        }
        return first;
    }

    void append(LocalIndex i, Collected& collected) const {
        for (int a = 0; a < all_.dimension; ++a)
            collected.coordinates.push_back(all_.coordinate(i, a));
        if (!all_.weights.empty()) collected.weights.push_back(all_.weight(i));
        collected.original.push_back(i);
    }

    PartTotals totals(int num_parts) const {
        PartTotals totals;
        totals.weights.resize(static_cast<std::size_t>(num_parts));
        totals.counts.resize(static_cast<std::size_t>(num_parts));
        for (LocalIndex i = 0; i < all_.count; ++i) {
            if (parts_[i] == no_part) continue;
            totals.weights[static_cast<std::size_t>(parts_[i])] += all_.weight(i);
            totals.counts[static_cast<std::size_t>(parts_[i])] += 1;
        }
        return totals;
    }

  protected:
    Points all_;
    std::span<const double> weights_;
    std::vector<Part> parts_;
};

}  // namespace rrcb::test
