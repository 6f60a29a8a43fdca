#include "refinement/refinement_mpi.hpp"

#include "bisection/bisection.hpp"
#include "collective/communicator.hpp"
#include "cuts/direct_assignment.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double sum_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

// A node that is searched has two parts or more.
Refinement::Refinement(const Options& options, int dimension, bool is_root, PartSums& sums)
    : options_(options),
      sums_(sums),
      level_(options.part_sizes.size() / 2, {.limits = axis_limits(options)}, dimension, is_root) {
    const std::size_t num_parts = options.part_sizes.size();
    nodes_.reserve(num_parts);
    children_.reserve(num_parts);
    lots_.reserve(num_parts);
    divided_.reserve(num_parts);
    if (options.refine != Refine::exact && !are_cuts_limited(options))
        correction_.emplace(options.num_parts, is_root);
}

Refined Refinement::refine(Estimate&& estimate, const Points& points, const Bin& bin,
                           std::span<Part> parts, Participant& self) {
    start(std::move(estimate), self);
    const bool is_known = estimate_.is_counted || (rule_.is_exact && !are_cuts_limited(options_));
    const bool is_accepted = !is_known && accept_estimate(points, parts, self);
    if (rule_.is_exact || !(is_accepted || correct(points, parts, self))) search(bin, parts, self);
    refined_.cuts = std::move(estimate_.cuts);
    return std::move(refined_);
}

/// Searches the cuts level by level, and once more, exactly, where that misses a tolerance.
/// Collective.
void Refinement::search(const Bin& bin, std::span<Part> parts, Participant& self) {
    if (limits_) {
        search_for_better(bin, parts, self);
    } else {
        search_all_levels(bin, parts, self);
    }
    const bool missed = refined_.imbalance > options_.imbalance_tolerance;
    if (missed && !std::exchange(rule_.is_exact, true)) search_for_better(bin, parts, self);
}

/// Takes an estimate, and derives from it what belongs below cuts and where they may lie.
void Refinement::start(Estimate&& estimate, Participant& self) {
    const auto& sizes = options_.part_sizes;
    const bool is_limited = are_cuts_limited(options_);
    estimate_ = std::move(estimate);
    rule_ = {sizes,
             options_.imbalance_tolerance,
             estimate_.common_weight,
             estimate_.heaviest,
             estimate_.total_weight / sum_of(sizes),
             0,
             options_.refine == Refine::exact,
             estimate_.is_earlier && !is_limited};
    if (is_limited)
        self.attempt([&] {
            limits_.emplace(options_, estimate_.box, estimate_.cuts.dimension,
                            GivenAxes{axes_of(estimate_.cuts.tree), {}});
        });
    if (estimate_.is_counted) {
        refined_.rounds = 1;
        refined_.imbalance = imbalance(sums_.sums(), sizes);
        rule_.counted_weight = sum_of(sums_.sums());
    }
}

/// True when there is nothing to search: the estimated cuts are good enough as they are, and
/// `parts` is complete, or the current parts are. Collective.
bool Refinement::accept_estimate(const Points& points, std::span<Part> parts, Participant& self) {
    self.attempt([&] {
        const PartTotals totals = assign_and_count(estimate_.cuts, points, parts);
        std::ranges::copy(totals.weights, sums_.here().begin());
    });
    measure(self);
    ++refined_.rounds;
    const double tolerance = options_.imbalance_tolerance;
    return refined_.imbalance <= tolerance || estimate_.current_imbalance <= tolerance;
}

/// True when counted cuts, corrected all at once, are good enough, and `parts` is complete.
/// Otherwise the cuts are counted as they are now. Collective.
bool Refinement::correct(const Points& points, std::span<Part> parts, Participant& self) {
    if (!correction_) return false;
    refined_.rounds += correction_->run(rule_, points, estimate_.brackets, estimate_.cuts, parts,
                                        sums_, refined_.imbalance, self);
    rule_.counted_weight = sum_of(sums_.sums());
    return refined_.imbalance <= options_.imbalance_tolerance;
}

/// Adds up what the parts weigh on all ranks, on every rank. Collective; throws where one failed.
void Refinement::measure(const Participant& self) {
    refined_.imbalance = sums_.add_up(options_.part_sizes, self);
    rule_.counted_weight = sum_of(sums_.sums());
}

/// Finds the cuts of one level after the other, and the parts at the end. Collective.
void Refinement::search_all_levels(const Bin& bin, std::span<Part> parts, Participant& self) {
    const bool is_counted = !rule_.is_exact && !limits_;
    nodes_.push_back({root_of(estimate_.cuts), {}, estimate_.total_weight, is_counted});
    if (limits_) nodes_[0].region = limits_->region();
    self.attempt([&] {
        points_ = sort_by_cell(bin());
        nodes_[0].fragments = cell_fragments(points_);
    });
    depth_ = 0;
    const bool recounts = rule_.is_earlier && !rule_.is_exact;
    // All nodes are of one level; together with the parts written they hold every point once.
    while (!nodes_.empty()) {
        write_parts(parts);
        start_level();
        refined_.rounds += level_.run(rule_, self);
        place_in_lots(self);
        descend(self);
        if (recounts) recount(parts, self);
        ++depth_;
    }
    if (!recounts) measure(self);
}

/// Writes the parts that the level holds, and takes them out of it, with nodes whose parts were
/// written when they were counted.
void Refinement::write_parts(std::span<Part> parts) {
    std::erase_if(nodes_, [&](const Node& node) {
        if (node.is_counted && rule_.are_within(node.at, sums_.sums())) return true;
        if (!node.at.is_part()) return false;
        if (node.is_counted) return true;
        const Part part = node.at.first_part;
        sums_.here()[static_cast<std::size_t>(part)] =
            write_part(node.fragments, part, points_, parts);
        return true;
    });
}

/// True when counting finds the cut of a node: when it divides weight among parts on both sides.
bool Refinement::needs_search(const Node& node) const {
    const double share = rule_.share_below(node.at);
    const bool stays = node.is_counted && rule_.may_stay(node.at, sums_.sums());
    return share > 0 && share < 1 && node.weight > 0 && !stays;
}

/// Counts the parts below cuts that moved, where there are any, by the cuts as they are. Collective
/// there.
void Refinement::recount(std::span<Part> parts, Participant& self) {
    if (std::ranges::all_of(nodes_, &Node::is_counted)) return;
    self.attempt([&] {
        for (const Node& node : nodes_)
            if (!node.is_counted)
                rrcb::write_parts(node.fragments, estimate_.cuts, node.at, points_, parts,
                                  sums_.here());
    });
    measure(self);
    ++refined_.rounds;
    for (Node& node : nodes_) node.is_counted = true;
}

void Refinement::start_level() {
    level_.clear();
    for (Node& node : nodes_) {
        if (!node.is_counted) continue;
        node.weight = weight_of(node.at, sums_.sums());
        node.below = weight_of(node.at.lower(), sums_.sums());
    }
    for (const Node& node : nodes_) {
        if (!needs_search(node)) continue;
        const Places places = places_of(node);
        level_.add(node, first_search(node, places), places, points_);
    }
}

/// The places of the cut of a node that divides.
Places Refinement::places_of(const Node& node) {
    if (!limits_) return {};
    return limits_->places(node.at, node.region, estimate_.cuts.tree[node.at.node].axis);
}

/// The search for the cut of a node, before anything is counted.
CutSearch Refinement::first_search(const Node& node, const Places& places) const {
    CutSearch search;
    search.cut.axis = estimate_.cuts.tree[node.at.node].axis;
    search.num_axes = options_.axes.plain ? 1 : estimate_.cuts.dimension;
    search.divides = options_.coincident == Coincident::divide && !options_.axes.plain ? 1 : 0;
    search.cut.at.fill(-infinity);
    const Bracket bracket = bracket_of(node);
    search.lower = bracket.lower;
    search.upper = bracket.upper;
    search.quantum = quantum_for(node.weight);
    if (limits_) {
        const AxisLimits& limits = limits_->across(search.cut.axis);
        search.lower = limits.nearest(search.lower, places.first, places.last);
        search.upper = limits.nearest(search.upper, search.lower, places.last);
    }
    return search;
}

/// Where the cut of a node is looked for: to a tolerance in wider bins than for an exact cut, so
/// that a cut that is far off is found as soon; where it is known how far, on one side of it.
Bracket Refinement::bracket_of(const Node& node) const {
    constexpr double largest = std::numeric_limits<double>::max();
    constexpr double caution = 2;
    double widths = 4;
    Bracket bracket = estimate_.brackets[node.at.node];
    if (rule_.is_exact || limits_) return bracket;
    const Cut& cut = estimate_.cuts.tree[node.at.node];
    const double value =
        std::clamp(cut.at[static_cast<std::size_t>(cut.axis)], bracket.lower, bracket.upper);
    if (node.is_counted) {
        const double target = rule_.target_of(node.at, node.weight, node.below).target;
        const double error = (target - node.below) / node.weight;
        widths *= std::max(1.0, caution * std::abs(error) / expected_error(depth_));
        if (error < 0) bracket.upper = std::nextafter(value, infinity);
        if (error > 0) bracket.lower = value;
    }
    return {std::max(std::lerp(value, bracket.lower, widths), -largest),
            std::lerp(value, bracket.upper, widths)};
}

/// Keeps all points off a side whose parts have no size; another cut without a search stays, a
/// limited one in its places.
void Refinement::set_aside(const Node& node, Cut& cut) {
    const double share = rule_.share_below(node.at);
    if (share > 0 && share < 1) {
        if (limits_) cut = limits_->nearest(cut, places_of(node));
        return;
    }
    cut = plane(cut.axis, share > 0 ? infinity : -infinity);
}

/// Finds where in its lot each rank begins, for the cuts that divide one. Collective where there
/// are any.
void Refinement::place_in_lots(const Participant& self) {
    lots_.clear();
    for (std::size_t k = 0; k < level_.size(); ++k) {
        const CutSearch& search = level_.search(k);
        if (!(search.lot_below > 0)) continue;
        const double weight = weight_at(search.cut, level_.node(k).fragments, points_);
        lots_.push_back(rounded_to(search.quantum, weight));
    }
    if (lots_.empty()) return;
    const bool is_first = mpi::rank_of(self.comm) == 0;
    mpi::check(MPI_Exscan(MPI_IN_PLACE, lots_.data(), mpi::to_int(std::ssize(lots_)), MPI_DOUBLE,
                          MPI_SUM, self.comm),
               "MPI_Exscan");
    // Where there are no ranks before it MPI leaves what was there.
    if (is_first) std::ranges::fill(lots_, 0.0);
}

/// Goes on with the nodes below, by the cuts that the level found.
void Refinement::descend(Participant& self) {
    children_.clear();
    divided_.clear();
    // Searches, and lots of the searches that divide one, stand in the order of their nodes.
    std::size_t next = 0;
    auto before = lots_.begin();
    for (Node& node : nodes_) {
        Cut& cut = estimate_.cuts.tree[node.at.node];
        double below = 0;
        bool is_counted = false;
        Lot lot;
        if (needs_search(node)) {
            const CutSearch& search = level_.search(next++);
            cut = search.cut;
            below = search.below;
            lot.below = search.lot_below;
            if (lot.below > 0) {
                lot.before = *before++;
                divided_.insert(divided_.end(), {children_.size(), children_.size() + 1});
            }
            cut.divides = lot.below > 0 ? 1 : 0;
            refined_.coincident_cuts += search.coincident;
        } else {
            set_aside(node, cut);
            const double share = rule_.share_below(node.at);
            is_counted = node.is_counted && share > 0 && share < 1;
            below = is_counted ? node.below : share > 0 ? node.weight : 0;
        }
        std::pair<std::vector<Fragment>, std::vector<Fragment>> halves;
        self.attempt([&] { halves = split(node.fragments, cut, lot, points_); });
        children_.push_back({node.at.lower(), std::move(halves.first), below, is_counted,
                             not_counted, box_below(node.region, cut)});
        children_.push_back({node.at.upper(), std::move(halves.second), node.weight - below,
                             is_counted, not_counted, box_above(node.region, cut)});
    }
    weigh_divided(self);
    std::swap(nodes_, children_);
}

/// Adds up the weight on both sides of each cut that divides a lot, which may be off by nearly a
/// point's: more than all other points if that is heavy. Collective where there are any.
void Refinement::weigh_divided(const Participant& self) {
    if (divided_.empty()) return;
    lots_.clear();
    for (const std::size_t child : divided_) {
        const std::size_t sibling = child % 2 == 0 ? child + 1 : child - 1;
        const double quantum = quantum_for(children_[child].weight + children_[sibling].weight);
        lots_.push_back(rounded_to(quantum, weight_of(children_[child].fragments)));
    }
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, lots_.data(), mpi::to_int(std::ssize(lots_)), MPI_DOUBLE,
                             MPI_SUM, self.comm),
               "MPI_Allreduce");
    auto weight = lots_.begin();
    for (const std::size_t child : divided_) children_[child].weight = *weight++;
}

/// Searches all cuts, and keeps them where they are better than those before. Collective.
void Refinement::search_for_better(const Bin& bin, std::span<Part> parts, Participant& self) {
    struct {
        std::vector<Cut> tree;
        std::vector<Part> parts;
        std::vector<double> sums;
        int coincident_cuts = 0;
    } before;
    self.attempt([&] {
        before = {estimate_.cuts.tree,
                  {parts.begin(), parts.end()},
                  sums_.saved(),
                  std::exchange(refined_.coincident_cuts, 0)};
    });
    const double imbalance_before = refined_.imbalance;
    search_all_levels(bin, parts, self);
    if (refined_.imbalance < imbalance_before) return;
    refined_.imbalance = imbalance_before;
    refined_.coincident_cuts = before.coincident_cuts;
    estimate_.cuts.tree = std::move(before.tree);
    sums_.restore(std::move(before.sums));
    std::ranges::copy(before.parts, parts.begin());
}

}  // namespace rrcb
