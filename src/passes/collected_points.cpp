#include "passes/collected_points.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/position_order.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace rrcb {

std::unique_ptr<OpenPoints> PointPasses::open(const Cuts&, std::span<const Bracket>, bool) {
    return nullptr;
}

std::unique_ptr<OpenPoints> open_points(PointPasses& points, const Cuts& cuts,
                                        std::span<const Bracket> intervals, bool has_parts,
                                        OpenMemory& memory) {
    if (auto open = points.open(cuts, intervals, has_parts)) return open;
    return std::make_unique<CollectedPoints>(points, cuts, intervals, has_parts, memory);
}

namespace {

const Entries no_entries;

bool is_at(const Cut& cut, const Vector& position, int dimension) {
    return std::equal(position.begin(), position.begin() + dimension, cut.at.begin());
}

void widen_box(Box& box, const Vector& position) {
    for (std::size_t a = 0; a < max_dimension; ++a) {
        box.lower[a] = std::min(box.lower[a], position[a]);
        box.upper[a] = std::max(box.upper[a], position[a]);
    }
}

}  // namespace

CollectedPoints::CollectedPoints(PointPasses& points, const Cuts& cuts,
                                 std::span<const Bracket> intervals, bool has_parts,
                                 OpenMemory& memory)
    : points_(points),
      memory_(memory),
      collected_(std::move(memory.points)),
      parts_(std::move(memory.parts)),
      num_parts_(cuts.num_parts) {
    const Descent root = root_of(cuts);
    if (std::ssize(cuts.tree) == cuts.num_parts - 1) {
        cuts_ = &cuts;
        steps_.resize(cuts.tree.size());
        arrived_.resize(cuts.tree.size() + 1);
        waiting_.resize(cuts.tree.size());
        points_.collect(cuts, intervals, has_parts, collected_);
        parts_.assign(collected_.count(), no_part);
        add_steps(root, intervals);
        for (LocalIndex i = 0; i < collected_.count(); ++i) send(root, i);
        return;
    }
    // A cut whose interval is infinite leaves all points open.
    const Bracket anywhere{-infinity, infinity};
    const Cuts halves{.dimension = cuts.dimension, .num_parts = 2, .tree = {plane(0, 0)}};
    points_.collect(halves, {&anywhere, 1}, false, collected_);
    parts_.assign(collected_.count(), no_part);
    Entries& all = held_[place_of(root)];
    all.resize(collected_.count());
    std::iota(all.begin(), all.end(), LocalIndex{0});
}

void CollectedPoints::add_steps(const Descent& at, std::span<const Bracket> intervals) {
    if (at.is_part()) return;
    steps_[at.node] = {intervals[at.node], cuts_->tree[at.node].axis, at.lower_parts()};
    add_steps(at.lower(), intervals);
    add_steps(at.upper(), intervals);
}

const Entries& CollectedPoints::waiting_at(const Descent& at) const {
    if (has_cuts()) return at.is_part() ? no_entries : waiting_[at.node];
    const auto found = held_.find(place_of(at));
    return found == held_.end() ? no_entries : found->second;
}

const Entries& CollectedPoints::candidates_at(const Descent& at) const {
    const auto found = chosen_.find(place_of(at));
    return found == chosen_.end() ? waiting_at(at) : found->second;
}

double CollectedPoints::weight_at(const Descent& at) const {
    double weight = 0;
    for (const LocalIndex i : waiting_at(at)) weight += collected_.weight(i);
    return weight;
}

Total CollectedPoints::total_of(Part part) const {
    return arrived_[part] +
           Total{collected_.settled.weights[part], collected_.settled.counts[part]};
}

Total CollectedPoints::total_in(const Descent& at) const {
    Total total;
    if (!has_cuts()) return total;
    for (Part p = at.first_part; p < at.first_part + at.num_parts; ++p) total = total + total_of(p);
    for (const Entries& some : waiting_in(at))
        for (const LocalIndex i : some) total = total + Total{collected_.weight(i), 1};
    return total;
}

void CollectedPoints::count(const Descent& at, int axis, const Bins& bins,
                            const HistogramLayout& layout, std::span<double> histogram) const {
    rrcb::count(collected_, candidates_at(at), axis, bins, layout, histogram);
}

void CollectedPoints::count_sums(const Descent& at, int axis, const Bins& bins,
                                 const HistogramLayout& layout, std::span<double> sums) const {
    rrcb::count_sums(collected_, candidates_at(at), axis, bins, layout, sums);
}

void CollectedPoints::choose(const Descent& at, int axis, const Bracket& interval) {
    chosen_[place_of(at)] =
        between(interval.lower, interval.upper, axis, candidates_at(at), collected_);
}

void CollectedPoints::take(const Descent& at, std::vector<double>& records) const {
    for (const LocalIndex i : candidates_at(at)) {
        const Vector x = collected_.position(i);
        records.insert(records.end(), x.begin(), x.begin() + collected_.dimension);
        records.push_back(collected_.weight(i));
    }
}

PointsInLot CollectedPoints::lot(const Descent& at, const Cut& cut) const {
    PointsInLot found;
    Entries entries = waiting_at(at);
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

Gap CollectedPoints::gap(const Descent& at, const Cut& cut) {
    Gap gap;
    gap.fill(-infinity);
    if (!has_cuts()) {
        narrow(cut, waiting_at(at), gap);
        return gap;
    }
    for (const Entries& some : waiting_in(at)) narrow(cut, some, gap);
    const Bracket& interval = steps_[at.node].interval;
    const bool is_open = gap[0] < -interval.upper || gap[1] < interval.lower;
    if (is_open) narrow_by_parts(at, cut, gap);
    return gap;
}

void CollectedPoints::narrow(const Cut& cut, const Entries& entries, Gap& gap) const {
    const int dimension = collected_.dimension;
    for (const LocalIndex i : entries) {
        const Vector x = collected_.position(i);
        const bool above = is_above(cut, x, dimension);
        for (int k = 0; k < dimension; ++k) {
            const std::size_t axis = ordering_axis(cut.axis, k);
            double& end = gap[2 * k + (above ? 0 : 1)];
            end = std::max(end, above ? -x[axis] : x[axis]);
            if (x[axis] != cut.at[axis]) break;
        }
    }
}

/// Narrows a gap along its first axis by the settled points, none of which is exactly at the cut.
void CollectedPoints::narrow_by_parts(const Descent& at, const Cut& cut, Gap& gap) {
    if (part_boxes_.empty()) {
        part_boxes_ = points_.boxes(num_parts_);
        for (LocalIndex i = 0; i < parts_.size(); ++i)
            if (parts_[i] != no_part) widen_box(part_boxes_[parts_[i]], collected_.position(i));
    }
    const Part middle = at.upper().first_part;
    for (Part p = at.first_part; p < middle; ++p)
        gap[1] = std::max(gap[1], part_boxes_[p].upper[cut.axis]);
    for (Part p = middle; p < at.first_part + at.num_parts; ++p)
        gap[0] = std::max(gap[0], -part_boxes_[p].lower[cut.axis]);
}

/// Removes and returns the points that wait at a node, which then has no candidates.
Entries CollectedPoints::take_at(const Descent& at) {
    chosen_.erase(place_of(at));
    if (has_cuts()) return std::exchange(waiting_[at.node], {});
    const auto taken = held_.extract(place_of(at));
    return taken.empty() ? Entries{} : std::move(taken.mapped());
}

/// Returns 1 for each entry above a cut, and 0 for the others. If the cut divides coincident
/// points, the entries must ascend.
std::vector<char> CollectedPoints::sides_of(const Entries& entries, const Cut& cut,
                                            const Lot& lot) const {
    double sum = 0;
    std::vector<char> sides(entries.size());
    for (std::size_t k = 0; k < entries.size(); ++k) {
        const LocalIndex i = entries[k];
        const double x = collected_.coordinate(i, cut.axis);
        sides[k] = x > cut.at[cut.axis] ? 1 : 0;
        if (x != cut.at[cut.axis]) continue;
        const Vector position = collected_.position(i);
        bool above = is_above(cut, position, collected_.dimension);
        if (lot.below > 0 && is_at(cut, position, collected_.dimension)) {
            above = lot.is_above(sum, collected_.weight(i));
            sum += collected_.weight(i);
        }
        sides[k] = above ? 1 : 0;
    }
    return sides;
}

void CollectedPoints::cut(const Descent& at, const Cut& cut, const Lot& lot) {
    Entries lower;
    Entries upper;
    {
        Entries entries = take_at(at);
        if (lot.below > 0) std::ranges::sort(entries);
        const std::vector<char> sides = sides_of(entries, cut, lot);
        // Reserves exact lengths, because the entries may be all points of the rank.
        const auto num_above = static_cast<std::size_t>(std::ranges::count(sides, 1));
        lower.reserve(entries.size() - num_above);
        upper.reserve(num_above);
        for (std::size_t k = 0; k < entries.size(); ++k)
            (sides[k] != 0 ? upper : lower).push_back(entries[k]);
    }
    if (has_cuts()) {
        send(at.lower(), lower);
        send(at.upper(), upper);
        return;
    }
    if (!lower.empty()) held_.emplace(place_of(at.lower()), std::move(lower));
    if (!upper.empty()) held_.emplace(place_of(at.upper()), std::move(upper));
}

void CollectedPoints::send(const Descent& from, const Entries& entries) {
    for (const LocalIndex i : entries) send(from, i);
}

/// Moves a point down the tree, to its part or to the first node where it has to wait.
void CollectedPoints::send(const Descent& from, LocalIndex i) {
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

/// Settles a point in a part and adds it to the totals.
void CollectedPoints::settle(LocalIndex i, Part part) {
    parts_[i] = part;
    arrived_[part] = arrived_[part] + Total{collected_.weight(i), 1};
    if (!part_boxes_.empty()) widen_box(part_boxes_[part], collected_.position(i));
}

void CollectedPoints::widen(std::span<const WiderNode> nodes) {
    const std::vector<Entries> below = take_below(nodes);
    std::vector<Wanted> wanted;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const auto& [at, interval] = nodes[k];
        Step& step = steps_[at.node];
        step.interval = interval;
        wanted.push_back({at.first_part, at.num_parts, step.axis, interval});
        const Entries& waiting = waiting_[at.node];
        const auto num_before = static_cast<std::ptrdiff_t>(waiting.size());
        send(at, below[k]);
        Entries& chosen = chosen_[place_of(at)];
        chosen.insert(chosen.end(), waiting.begin() + num_before, waiting.end());
    }
    LocalIndex next = collected_.count();
    for (const std::size_t k : points_.collect_more(wanted, collected_)) {
        waiting_[nodes[k].at.node].push_back(next);
        chosen_[place_of(nodes[k].at)].push_back(next++);
    }
    parts_.resize(next, no_part);
}

/// Removes and returns the points that wait at or below some nodes, or have arrived in their parts.
std::vector<Entries> CollectedPoints::take_below(std::span<const WiderNode> nodes) {
    std::vector<Entries> taken(nodes.size());
    std::vector<std::size_t> node_of_part(arrived_.size(), nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const Descent& at = nodes[k].at;
        for (std::size_t node = at.node + 1; node < at.node + waiting_in(at).size(); ++node) {
            Entries& some = waiting_[node];
            taken[k].insert(taken[k].end(), some.begin(), some.end());
            some.clear();
        }
        std::fill_n(node_of_part.begin() + at.first_part, at.num_parts, k);
        std::fill_n(arrived_.begin() + at.first_part, at.num_parts, Total{});
    }
    for (LocalIndex i = 0; i < collected_.count(); ++i) {
        Part& part = parts_[i];
        if (part == no_part || node_of_part[part] == nodes.size()) continue;
        taken[node_of_part[part]].push_back(i);
        part = no_part;
    }
    part_boxes_.clear();
    return taken;
}

/// Settles the points that wait at or below a node, according to the cuts.
void CollectedPoints::settle_waiting(const Descent& at) {
    if (at.is_part()) return;
    for (const LocalIndex i : take_at(at))
        settle(i, descend(*cuts_, collected_.position(i), at).first_part);
    settle_waiting(at.lower());
    settle_waiting(at.upper());
}

std::vector<double> CollectedPoints::settle() {
    std::vector<double> weights(static_cast<std::size_t>(num_parts_));
    if (has_cuts()) {
        settle_waiting(root_of(*cuts_));
        for (Part part = 0; part < num_parts_; ++part) weights[part] = total_of(part).weight;
    }
    for (const auto& [place, entries] : held_)
        for (const LocalIndex i : entries) {
            parts_[i] = place.first;
            weights[place.first] += collected_.weight(i);
        }
    points_.settle(collected_, parts_);
    memory_ = {std::move(collected_), std::move(parts_)};
    return weights;
}

}  // namespace rrcb
