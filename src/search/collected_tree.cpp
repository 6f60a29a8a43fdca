#include "search/collected_tree.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/position_order.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rrcb {

namespace {

bool is_at(const Cut& cut, const Vector& position, int dimension) {
    return std::equal(position.begin(), position.begin() + dimension, cut.at.begin());
}

void widen(Box& box, const Vector& position) {
    for (std::size_t a = 0; a < max_dimension; ++a) {
        box.lower[a] = std::min(box.lower[a], position[a]);
        box.upper[a] = std::max(box.upper[a], position[a]);
    }
}

}  // namespace

CollectedTree::CollectedTree(PointPasses& points, OpenPoints&& all)
    : points_(points), collected_(std::move(all)) {
    collected_.parts.assign(collected_.count(), no_part);
}

CollectedTree::CollectedTree(PointPasses& points, const Cuts& cuts,
                             std::span<const Bracket> intervals, bool has_parts,
                             OpenPoints&& memory)
    : points_(points),
      collected_(std::move(memory)),
      arrived_(cuts.tree.size() + 1),
      steps_(cuts.tree.size()),
      waiting_(cuts.tree.size()) {
    points_.collect(cuts, intervals, has_parts, collected_);
    collected_.parts.assign(collected_.count(), no_part);
    add_steps(root_of(cuts), cuts, intervals);
    const Place root{0, 0, cuts.num_parts};
    for (LocalIndex i = 0; i < collected_.count(); ++i) send(root, i);
}

void CollectedTree::add_steps(const Descent& at, const Cuts& cuts,
                              std::span<const Bracket> intervals) {
    if (at.is_part()) return;
    steps_[at.node] = {intervals[at.node], cuts.tree[at.node].axis, at.lower_parts()};
    add_steps(at.lower(), cuts, intervals);
    add_steps(at.upper(), cuts, intervals);
}

std::vector<Entries> CollectedTree::collect_more(std::span<const std::size_t> nodes,
                                                 std::span<const Wanted> wanted) {
    for (std::size_t k = 0; k < wanted.size(); ++k) steps_[nodes[k]].interval = wanted[k].interval;
    std::vector<Entries> found = reopen(nodes, wanted);
    LocalIndex next = collected_.count();
    for (const std::size_t k : points_.collect_more(wanted, collected_)) found[k].push_back(next++);
    collected_.parts.resize(next, no_part);
    part_boxes_.clear();
    return found;
}

/// Returns the entries in the new intervals of nodes that wait below these, or have arrived.
std::vector<Entries> CollectedTree::reopen(std::span<const std::size_t> nodes,
                                           std::span<const Wanted> wanted) {
    std::vector<Entries> found(wanted.size());
    const auto takes = [&](std::size_t k, LocalIndex i) {
        const bool is_inside = wanted[k].contains(collected_.coordinate(i, wanted[k].axis));
        if (is_inside) found[k].push_back(i);
        return is_inside;
    };
    std::vector<std::size_t> wanted_of_part(arrived_.size(), wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        for (int below = 1; below + 1 < wanted[k].num_parts; ++below)
            std::erase_if(waiting_[nodes[k] + static_cast<std::size_t>(below)],
                          [&](LocalIndex i) { return takes(k, i); });
        std::fill_n(wanted_of_part.begin() + wanted[k].first_part, wanted[k].num_parts, k);
        std::fill_n(arrived_.begin() + wanted[k].first_part, wanted[k].num_parts, Total{});
    }
    for (LocalIndex i = 0; i < collected_.parts.size(); ++i) {
        Part& part = collected_.parts[i];
        const std::size_t k = part == no_part ? wanted.size() : wanted_of_part[part];
        if (k == wanted.size()) continue;
        if (takes(k, i)) {
            part = no_part;
        } else {
            arrived_[part] = arrived_[part] + Total{collected_.weight(i), 1};
        }
    }
    return found;
}

Entries CollectedTree::all() const {
    Entries entries(collected_.count());
    std::iota(entries.begin(), entries.end(), LocalIndex{0});
    return entries;
}

/// Returns the part of a point, or the first node at or below `at` where it waits.
CollectedTree::Place CollectedTree::descend(Place at, LocalIndex i) const {
    while (at.num_parts > 1) {
        const Step& step = steps_[at.node];
        const double x = collected_.coordinate(i, step.axis);
        if (x < step.interval.lower) {
            at = {at.node + 1, at.first_part, step.lower_parts};
        } else if (x >= step.interval.upper) {
            at = {at.node + static_cast<std::size_t>(step.lower_parts),
                  at.first_part + step.lower_parts, at.num_parts - step.lower_parts};
        } else {
            break;
        }
    }
    return at;
}

/// Lets a point go down as far as it may.
void CollectedTree::send(const Place& from, LocalIndex i) {
    const Place at = descend(from, i);
    if (at.num_parts > 1) {
        waiting_[at.node].push_back(i);
    } else {
        settle(i, at.first_part);
    }
}

Entries CollectedTree::admit(const Descent& at, const Entries& arrived) {
    const Place place{at.node, at.first_part, at.num_parts};
    for (const LocalIndex i : arrived) send(place, i);
    return at.is_part() ? Entries{} : std::exchange(waiting_[at.node], {});
}

void CollectedTree::settle(const Entries& entries, Part part) {
    for (const LocalIndex i : entries) collected_.parts[i] = part;
}

/// Settles a point in a part; adds it to the totals.
void CollectedTree::settle(LocalIndex i, Part part) {
    collected_.parts[i] = part;
    arrived_[part] = arrived_[part] + Total{collected_.weight(i), 1};
    if (!part_boxes_.empty()) widen(part_boxes_[part], collected_.position(i));
}

/// Makes the boxes of the points that have their parts.
void CollectedTree::make_part_boxes() {
    part_boxes_ = points_.boxes(static_cast<int>(steps_.size()) + 1);
    for (LocalIndex i = 0; i < collected_.parts.size(); ++i)
        if (collected_.parts[i] != no_part)
            widen(part_boxes_[collected_.parts[i]], collected_.position(i));
}

Total CollectedTree::total_of(Part part) const {
    return arrived_[part] +
           Total{collected_.settled.weights[part], collected_.settled.counts[part]};
}

Total CollectedTree::total_in(const Descent& at) const {
    Total total;
    for (Part p = at.first_part; p < at.first_part + at.num_parts; ++p) total = total + total_of(p);
    for (int k = 0; k + 1 < at.num_parts; ++k)
        for (const LocalIndex i : waiting_[at.node + static_cast<std::size_t>(k)])
            total = total + Total{collected_.weight(i), 1};
    return total;
}

std::pair<Entries, Entries> CollectedTree::divide(Entries&& entries, const Cut& cut,
                                                  const Lot& lot) const {
    double sum = 0;
    const bool divides = lot.below > 0;
    if (divides) std::ranges::sort(entries);
    std::vector<char> sides(entries.size());
    for (std::size_t k = 0; k < entries.size(); ++k) {
        const LocalIndex i = entries[k];
        const double x = collected_.coordinate(i, cut.axis);
        sides[k] = x > cut.at[cut.axis] ? 1 : 0;
        if (x != cut.at[cut.axis]) continue;
        const Vector position = collected_.position(i);
        bool above = rrcb::is_above(cut, position, collected_.dimension);
        if (divides && is_at(cut, position, collected_.dimension)) {
            above = lot.is_above(sum, collected_.weight(i));
            sum += collected_.weight(i);
        }
        sides[k] = above ? 1 : 0;
    }
    // Exact lengths, because the entries may be all points of the rank.
    const auto num_above = static_cast<std::size_t>(std::ranges::count(sides, 1));
    std::pair<Entries, Entries> halves;
    halves.first.reserve(entries.size() - num_above);
    halves.second.reserve(num_above);
    for (std::size_t k = 0; k < entries.size(); ++k)
        (sides[k] != 0 ? halves.second : halves.first).push_back(entries[k]);
    return halves;
}

void CollectedTree::count_parts(const Descent& at, const Entries& entries, const Cuts& cuts,
                                std::span<double> weights) const {
    for (Part p = at.first_part; p < at.first_part + at.num_parts; ++p)
        weights[p] += total_of(p).weight;
    const auto add = [&](const Descent& from, const Entries& some) {
        for (const LocalIndex i : some)
            weights[rrcb::descend(cuts, collected_.position(i), from).first_part] +=
                collected_.weight(i);
    };
    add(at, entries);
    const auto add_below = [&](const auto& self, const Descent& from) -> void {
        if (from.is_part()) return;
        add(from, waiting_[from.node]);
        self(self, from.lower());
        self(self, from.upper());
    };
    add_below(add_below, at);
}

double CollectedTree::weight_of(const Entries& entries) const {
    double weight = 0;
    for (const LocalIndex i : entries) weight += collected_.weight(i);
    return weight;
}

void CollectedTree::append(const Entries& entries, std::vector<double>& records) const {
    for (const LocalIndex i : entries) {
        const Vector x = collected_.position(i);
        records.insert(records.end(), x.begin(), x.begin() + collected_.dimension);
        records.push_back(collected_.weight(i));
    }
}

void CollectedTree::settle_rest(const Cuts& cuts) {
    const auto settle_below = [&](const auto& self, const Descent& at) -> void {
        if (at.is_part()) return;
        for (const LocalIndex i : std::exchange(waiting_[at.node], {}))
            settle(i, rrcb::descend(cuts, collected_.position(i), at).first_part);
        self(self, at.lower());
        self(self, at.upper());
    };
    settle_below(settle_below, root_of(cuts));
}

PointsInLot CollectedTree::points_at(const Cut& cut, Entries entries) const {
    PointsInLot found;
    std::ranges::sort(entries);
    for (const LocalIndex i : entries) {
        const double weight = collected_.weight(i);
        if (!is_at(cut, collected_.position(i), collected_.dimension) || !(weight > 0)) continue;
        if (found.weight == 0) found.first = weight;
        found.before_last = found.weight;
        found.last = weight;
        found.weight += weight;
    }
    return found;
}

Gap CollectedTree::gap_about(const Descent& at, const Entries& entries, const Cut& cut) {
    Gap gap;
    gap.fill(-infinity);
    narrow(cut, entries, gap);
    if (waiting_.empty()) return gap;
    for (int k = 0; k + 1 < at.num_parts; ++k)
        narrow(cut, waiting_[at.node + static_cast<std::size_t>(k)], gap);
    const bool is_open = gap[0] < -interval(at.node).upper || gap[1] < interval(at.node).lower;
    if (is_open && part_boxes_.empty()) make_part_boxes();
    if (is_open) narrow_by_parts(at, cut, gap);
    return gap;
}

void CollectedTree::narrow(const Cut& cut, const Entries& entries, Gap& gap) const {
    const int dimension = collected_.dimension;
    for (const LocalIndex i : entries) {
        const Vector x = collected_.position(i);
        const bool above = rrcb::is_above(cut, x, dimension);
        for (int k = 0; k < dimension; ++k) {
            const std::size_t axis = ordering_axis(cut.axis, k);
            double& end = gap[2 * k + (above ? 0 : 1)];
            end = std::max(end, above ? -x[axis] : x[axis]);
            if (x[axis] != cut.at[axis]) break;
        }
    }
}

/// Narrows a gap along its first axis by the settled points, which are not at the cut.
void CollectedTree::narrow_by_parts(const Descent& at, const Cut& cut, Gap& gap) const {
    const Part middle = at.upper().first_part;
    for (Part p = at.first_part; p < middle; ++p)
        gap[1] = std::max(gap[1], part_boxes_[p].upper[cut.axis]);
    for (Part p = middle; p < at.first_part + at.num_parts; ++p)
        gap[0] = std::max(gap[0], -part_boxes_[p].lower[cut.axis]);
}

}  // namespace rrcb
