// Passes over rows of points that exist as numbers only: rows are counted by formula.
#pragma once

#include "arithmetic/position_order.hpp"
#include "cuts/tree.hpp"

#include <rrcb/detail/passes.hpp>
#include <rrcb/detail/sample.hpp>

#include <algorithm>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace rrcb::test {

/// Points at equal steps along an axis; coincident ones if the step is 0.
struct Row {
    Vector first{};
    int axis = 0;
    double step = 0;  ///< >= 0
    LocalIndex count = 1;
    double weight = 1;  ///< of each point

    /// Returns the position of a point. No coordinate falls from a point to the next.
    Vector position(LocalIndex k) const {
        Vector x = first;
        x[static_cast<std::size_t>(axis)] += static_cast<double>(k) * step;
        return x;
    }
};

/// The rows of one rank. Memory and time are in proportion to the rows, the cuts through them, and
/// the points that are collected. Not for NaN or infinite coordinates.
class RowPasses final : public PointPasses {
  public:
    RowPasses(std::vector<Row> rows, int dimension)
        : rows_(std::move(rows)), dimension_(dimension) {
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            starts_.push_back(count_);
            count_ += rows_[row].count;
            pieces_.push_back({row, 0, rows_[row].count, no_part});
        }
    }

    int dimension() const override { return dimension_; }
    LocalIndex count() const override { return count_; }
    bool has_weights() const override { return true; }
    void use_weights(bool are_used) override { are_weights_used_ = are_used; }

    PointSummary summary(bool /*reads_positions*/) override {
        PointSummary summary;
        summary.count = count_;
        for (const Row& row : rows_) {
            const double weight = weight_of(row);
            summary.weight += static_cast<double>(row.count) * weight;
            summary.lightest = std::min(summary.lightest, weight);
            summary.heaviest = std::max(summary.heaviest, weight);
            for (const LocalIndex k : {LocalIndex{0}, row.count - 1})
                widen(row.position(k), summary);
        }
        return summary;
    }

    PointSample sample(LocalIndex size) override {
        PointSample sample;
        for (LocalIndex k = 0; k < std::min(size, count_); ++k) {
            const LocalIndex i = size < count_ ? detail::sampled(k, count_) : k;
            const auto row = static_cast<std::size_t>(std::ranges::upper_bound(starts_, i) -
                                                      starts_.begin() - 1);
            sample.positions.push_back(rows_[row].position(i - starts_[row]));
            sample.weights.push_back(weight_of(rows_[row]));
        }
        return sample;
    }

    /// Reads each point.
    std::vector<CellMoments> moments(const SupportMesh& mesh) override {
        std::vector<double> coordinates;
        std::vector<double> weights;
        for (const Row& row : rows_)
            for (LocalIndex k = 0; k < row.count; ++k) {
                const Vector x = row.position(k);
                coordinates.insert(coordinates.end(), x.begin(), x.begin() + dimension_);
                weights.push_back(weight_of(row));
            }
        return cell_moments(Points(coordinates, dimension_, weights), mesh);
    }

    PartTotals assign(const Cuts& cuts, bool counts) override {
        split_rows(cuts, [&](const Piece& piece, const Descent& at) {
            const LocalIndex middle = first_in(piece, [&](const Vector& x) {
                return is_above(cuts.tree[at.node], x, dimension_);
            });
            return std::pair{middle, middle};
        });
        return counts ? totals(cuts.num_parts) : PartTotals{};
    }

    void collect(const Cuts& cuts, std::span<const Bracket> intervals, bool /*has_parts*/,
                 Collected& collected) override {
        split_rows(cuts, [&](const Piece& piece, const Descent& at) {
            return ends_of(piece, cuts.tree[at.node].axis, intervals[at.node]);
        });
        collected = {};
        collected.dimension = dimension_;
        for (const Piece& piece : pieces_)
            if (piece.part == no_part) append(piece, collected);
        collected.settled = totals(cuts.num_parts);
    }

    std::vector<std::size_t> collect_more(std::span<const Wanted> wanted,
                                          Collected& collected) override {
        ++num_collections_;
        std::vector<std::size_t> found;
        for (const Piece& piece : std::exchange(pieces_, {})) {
            const auto one = std::ranges::find_if(wanted, [&](const Wanted& of) {
                return piece.part >= of.first_part && piece.part < of.first_part + of.num_parts;
            });
            const auto [first, end] = one == wanted.end()
                                          ? std::pair{piece.end, piece.end}
                                          : ends_of(piece, one->axis, one->interval);
            const Piece open{piece.row, first, end, no_part};
            add({piece.row, piece.first, first, piece.part});
            add(open);
            add({piece.row, end, piece.end, piece.part});
            append(open, collected);
            found.insert(found.end(), end - first, static_cast<std::size_t>(one - wanted.begin()));
        }
        collected.settled = totals(static_cast<int>(collected.settled.counts.size()));
        return found;
    }

    std::vector<Box> boxes(int num_parts) override {
        std::vector<PointSummary> of_parts(static_cast<std::size_t>(num_parts));
        for (const Piece& piece : pieces_)
            if (piece.part != no_part)
                for (const LocalIndex k : {piece.first, piece.end - 1})
                    widen(rows_[piece.row].position(k),
                          of_parts[static_cast<std::size_t>(piece.part)]);
        std::vector<Box> boxes;
        for (const PointSummary& one : of_parts) boxes.push_back(one.box);
        return boxes;
    }

    void settle(const Collected& collected, std::span<const Part> parts) override {
        std::map<LocalIndex, Part> found;
        for (LocalIndex k = 0; k < collected.count(); ++k) found[collected.original[k]] = parts[k];
        for (const Piece& piece : std::exchange(pieces_, {})) {
            if (piece.part != no_part) {
                add(piece);
                continue;
            }
            for (LocalIndex k = piece.first; k < piece.end; ++k)
                add({piece.row, k, k + 1, found.at(starts_[piece.row] + k)});
        }
    }

    void renumber(std::span<const Part> numbers) override {
        for (Piece& piece : pieces_)
            piece.part = numbers[numbers.size() == 1 ? 0 : static_cast<std::size_t>(piece.part)];
    }

    std::vector<Part> parts() const override {
        std::vector<Part> parts;
        for (const Piece& piece : pieces_)
            parts.insert(parts.end(), piece.end - piece.first, piece.part);
        return parts;
    }

    void set_parts(std::span<const Part> parts) override {
        pieces_.clear();
        for (std::size_t row = 0; row < rows_.size(); ++row)
            for (LocalIndex k = 0; k < rows_[row].count; ++k)
                add({row, k, k + 1, parts[starts_[row] + k]});
    }

    /// Returns the totals of all points that have a part.
    PartTotals totals(int num_parts) const {
        PartTotals totals;
        totals.weights.resize(static_cast<std::size_t>(num_parts));
        totals.counts.resize(static_cast<std::size_t>(num_parts));
        for (const Piece& piece : pieces_) {
            if (piece.part == no_part) continue;
            const auto count = static_cast<double>(piece.end - piece.first);
            totals.weights[static_cast<std::size_t>(piece.part)] +=
                count * weight_of(rows_[piece.row]);
            totals.counts[static_cast<std::size_t>(piece.part)] += count;
        }
        return totals;
    }

    /// Returns the number of calls of collect_more().
    int num_collections() const { return num_collections_; }

  private:
    /// Points of a row in one part.
    struct Piece {
        std::size_t row;
        LocalIndex first;
        LocalIndex end;
        Part part;
    };

    double weight_of(const Row& row) const { return are_weights_used_ ? row.weight : 1; }

    void widen(const Vector& x, PointSummary& summary) const {
        for (std::size_t a = 0; a < static_cast<std::size_t>(dimension_); ++a) {
            summary.box.lower[a] = std::min(summary.box.lower[a], x[a]);
            summary.box.upper[a] = std::max(summary.box.upper[a], x[a]);
            const PositionOrder before(static_cast<int>(a), 0, dimension_);
            summary.first[a] = std::min(summary.first[a], x, before);
            summary.last[a] = std::max(summary.last[a], x, before);
        }
    }

    /// Returns the first point of a piece from which on `holds` is true.
    template <class Holds>
    LocalIndex first_in(const Piece& piece, Holds&& holds) const {
        LocalIndex first = piece.first;
        for (LocalIndex length = piece.end - first; length > 0;) {
            const LocalIndex half = length / 2;
            if (holds(rows_[piece.row].position(first + half))) {
                length = half;
            } else {
                first += half + 1;
                length -= half + 1;
            }
        }
        return first;
    }

    /// Returns the first point of a piece in an interval, and the first above it.
    std::pair<LocalIndex, LocalIndex> ends_of(const Piece& piece, int axis,
                                              const Bracket& interval) const {
        const auto a = static_cast<std::size_t>(axis);
        const LocalIndex first =
            first_in(piece, [&](const Vector& x) { return x[a] >= interval.lower; });
        return {first, first_in({piece.row, first, piece.end, no_part},
                                [&](const Vector& x) { return x[a] >= interval.upper; })};
    }

    /// Sends all rows down a tree; ends(piece, node) returns the first point that is not below the
    /// cut, and the first above it. Those between have no part.
    template <class Ends>
    void split_rows(const Cuts& cuts, Ends&& ends) {
        const auto split = [&](const auto& self, const Piece& piece, const Descent& at) -> void {
            if (piece.first == piece.end) return;
            if (at.is_part()) return add({piece.row, piece.first, piece.end, at.first_part});
            const auto [first, end] = ends(piece, at);
            self(self, {piece.row, piece.first, first, no_part}, at.lower());
            add({piece.row, first, end, no_part});
            self(self, {piece.row, end, piece.end, no_part}, at.upper());
        };
        pieces_.clear();
        for (std::size_t row = 0; row < rows_.size(); ++row)
            split(split, {row, 0, rows_[row].count, no_part}, root_of(cuts));
    }

    /// Adds a piece behind the others, or lengthens the last one.
    void add(const Piece& piece) {
        if (piece.first == piece.end) return;
        const bool continues = !pieces_.empty() && pieces_.back().row == piece.row &&
                               pieces_.back().part == piece.part;
        if (continues) {
            pieces_.back().end = piece.end;
        } else {
            pieces_.push_back(piece);
        }
    }

    void append(const Piece& piece, Collected& collected) const {
        const Row& row = rows_[piece.row];
        for (LocalIndex k = piece.first; k < piece.end; ++k) {
            const Vector x = row.position(k);
            for (int a = 0; a < dimension_; ++a)
                collected.coordinates.push_back(x[static_cast<std::size_t>(a)]);
            collected.weights.push_back(weight_of(row));
            collected.original.push_back(starts_[piece.row] + k);
        }
    }

    std::vector<Row> rows_;
    int dimension_;
    std::vector<LocalIndex> starts_;  ///< index of the first point of each row
    LocalIndex count_ = 0;
    bool are_weights_used_ = true;
    int num_collections_ = 0;
    std::vector<Piece> pieces_;  ///< ascending, of all points
};

}  // namespace rrcb::test
