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
      cuts_(&cuts),
      steps_(cuts.tree.size()),
      arrived_(cuts.tree.size() + 1),
      waiting_(cuts.tree.size()) {
    points_.collect(cuts, intervals, has_parts, collected_);
    collected_.parts.assign(collected_.count(), no_part);
    add_steps(root_of(cuts), intervals);
    for (LocalIndex i = 0; i < collected_.count(); ++i) send(root_of(cuts), i);
}

void CollectedTree::add_steps(const Descent& at, std::span<const Bracket> intervals) {
    if (at.is_part()) return;
    steps_[at.node] = {intervals[at.node], cuts_->tree[at.node].axis, at.lower_parts()};
    add_steps(at.lower(), intervals);
    add_steps(at.upper(), intervals);
}

std::vector<Entries> CollectedTree::collect_more(std::span<const Descent> nodes,
                                                 std::span<const Bracket> intervals) {
    const std::vector<Entries> below = take_below(nodes);
    std::vector<Wanted> wanted;
    std::vector<Entries> found;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        Step& step = steps_[nodes[k].node];
        step.interval = intervals[k];
        wanted.push_back({nodes[k].first_part, nodes[k].num_parts, step.axis, intervals[k]});
        found.push_back(admit(nodes[k], below[k]));
    }
    LocalIndex next = collected_.count();
    for (const std::size_t k : points_.collect_more(wanted, collected_)) found[k].push_back(next++);
    collected_.parts.resize(next, no_part);
    return found;
}

/// Takes what waits below nodes or has arrived there.
std::vector<Entries> CollectedTree::take_below(std::span<const Descent> nodes) {
    std::vector<Entries> taken(nodes.size());
    std::vector<std::size_t> node_of_part(arrived_.size(), nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const Descent& at = nodes[k];
        for (Entries& some : waiting_below(at)) {
            taken[k].insert(taken[k].end(), some.begin(), some.end());
            some.clear();
        }
        std::fill_n(node_of_part.begin() + at.first_part, at.num_parts, k);
        std::fill_n(arrived_.begin() + at.first_part, at.num_parts, Total{});
    }
    for (LocalIndex i = 0; i < collected_.count(); ++i) {
        Part& part = collected_.parts[i];
        if (part == no_part || node_of_part[part] == nodes.size()) continue;
        taken[node_of_part[part]].push_back(i);
        part = no_part;
    }
    part_boxes_.clear();
    return taken;
}

Entries CollectedTree::all() const {
    Entries entries(collected_.count());
    std::iota(entries.begin(), entries.end(), LocalIndex{0});
    return entries;
}

/// Lets a point go down to its part, or to the first node where it waits.
void CollectedTree::send(const Descent& from, LocalIndex i) {
    std::size_t node = from.node;
    Part first_part = from.first_part;
    int num_parts = from.num_parts;
    while (num_parts > 1) {
        const Step& step = steps_[node];
        const double x = collected_.coordinate(i, step.axis);
        if (x < step.interval.lower) {
            ++node;
            num_parts = step.lower_parts;
        } else if (x >= step.interval.upper) {
            node += static_cast<std::size_t>(step.lower_parts);
            first_part += step.lower_parts;
            num_parts -= step.lower_parts;
        } else {
            return waiting_[node].push_back(i);
        }
    }
    settle(i, first_part);
}

Entries CollectedTree::admit(const Descent& at, const Entries& arrived) {
    for (const LocalIndex i : arrived) send(at, i);
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

Total CollectedTree::total_of(Part part) const {
    return arrived_[part] +
           Total{collected_.settled.weights[part], collected_.settled.counts[part]};
}

Total CollectedTree::total_in(const Descent& at) {
    Total total;
    for (Part p = at.first_part; p < at.first_part + at.num_parts; ++p) total = total + total_of(p);
    for (const Entries& some : waiting_below(at))
        for (const LocalIndex i : some) total = total + Total{collected_.weight(i), 1};
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

std::vector<double> CollectedTree::part_weights(const Descent& at, const Entries& entries) {
    std::vector<double> weights;
    for (Part p = at.first_part; p < at.first_part + at.num_parts; ++p)
        weights.push_back(total_of(p).weight);
    const auto add = [&](const Entries& some) {
        for (const LocalIndex i : some)
            weights[descend(*cuts_, collected_.position(i), at).first_part - at.first_part] +=
                collected_.weight(i);
    };
    add(entries);
    for (const Entries& some : waiting_below(at)) add(some);
    return weights;
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

void CollectedTree::settle_rest() {
    const auto settle_below = [&](const auto& self, const Descent& at) -> void {
        if (at.is_part()) return;
        for (const LocalIndex i : std::exchange(waiting_[at.node], {}))
            settle(i, descend(*cuts_, collected_.position(i), at).first_part);
        self(self, at.lower());
        self(self, at.upper());
    };
    settle_below(settle_below, root_of(*cuts_));
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
    for (const Entries& some : waiting_below(at)) narrow(cut, some, gap);
    const bool is_open = gap[0] < -interval(at.node).upper || gap[1] < interval(at.node).lower;
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
void CollectedTree::narrow_by_parts(const Descent& at, const Cut& cut, Gap& gap) {
    if (part_boxes_.empty()) {
        part_boxes_ = points_.boxes(cuts_->num_parts);
        for (LocalIndex i = 0; i < collected_.parts.size(); ++i)
            if (collected_.parts[i] != no_part)
                widen(part_boxes_[collected_.parts[i]], collected_.position(i));
    }
    const Part middle = at.upper().first_part;
    for (Part p = at.first_part; p < middle; ++p)
        gap[1] = std::max(gap[1], part_boxes_[p].upper[cut.axis]);
    for (Part p = middle; p < at.first_part + at.num_parts; ++p)
        gap[0] = std::max(gap[0], -part_boxes_[p].lower[cut.axis]);
}

}  // namespace rrcb
