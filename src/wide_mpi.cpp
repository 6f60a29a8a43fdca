#include "wide_mpi.hpp"

#include "bisection/axis_choice.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "cuts/cut_limits.hpp"
#include "cuts/direct_assignment.hpp"
#include "cuts/gather_cuts_mpi.hpp"
#include "cuts/part_share.hpp"
#include "cuts/path_search.hpp"
#include "cuts/tier_search_mpi.hpp"
#include "cuts/tree.hpp"
#include "lists/quality_mpi.hpp"
#include "options/validation.hpp"
#include "stage_scope.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

namespace rrcb {

namespace {

/// Calls visit(node) for each of the `num_regions` nodes, a power of two, that the tree of
/// `num_parts` parts has on one level.
template <class Visit>
void for_each_region(const Descent& at, int num_regions, Visit&& visit) {
    if (num_regions == 1) return visit(at);
    for_each_region(at.lower(), num_regions / 2, visit);
    for_each_region(at.upper(), num_regions / 2, visit);
}

/// Appends the axes of the cuts between these nodes.
void append_axes(const Descent& at, int num_regions, std::span<const int> cut_axes,
                 std::vector<int>& axes) {
    if (num_regions == 1) return;
    axes.push_back(cut_axes[at.node]);
    append_axes(at.lower(), num_regions / 2, cut_axes, axes);
    append_axes(at.upper(), num_regions / 2, cut_axes, axes);
}

/// Sum of the sizes of all parts, in those of the largest.
double parts_in_all(const Options& options) {
    if (options.part_sizes.empty()) return options.num_parts;
    return sum_of(options.part_sizes) / *std::ranges::max_element(options.part_sizes);
}

/// Gives points the number of the first part of their region, in place of its own.
void number_as_in_tree(int num_parts, Balance& result) {
    std::vector<Part> first_parts;
    for_each_region({0, 0, num_parts}, result.cuts.num_parts,
                    [&](const Descent& at) { first_parts.push_back(at.first_part); });
    for (Part& part : result.parts) part = first_parts[part];
}

PartTree tree_of(const Options& options, const Verdict& verdict, double weight, int num_ranks) {
    PartTree tree;
    tree.num_parts = options.num_parts;
    tree.num_ranks = num_ranks;
    tree.weight = weight;
    tree.part_sizes = options.part_sizes;
    if (options.axes.order.is_given()) tree.cut_axes = options.axes.order.axes();
    tree.rule.tolerance = options.imbalance_tolerance;
    tree.rule.common_weight = verdict.common_weight;
    tree.rule.heaviest = verdict.heaviest;
    tree.rule.is_exact = options.refine == Refine::exact;
    tree.share_of_longest = near_longest;
    tree.plain_cuts = options.axes.plain;
    tree.divides_coincident = options.coincident == Coincident::divide;
    return tree;
}

/// The cuts above each of these points, with what is known. Collective.
Cuts with_cuts_above(const Points& points, const Cuts& known, Participant& self) {
    std::vector<Part> parts;
    std::optional<SearchRoom<PathSearch>> room;
    self.attempt([&] {
        parts.resize(points.count);
        assign_known(known, points, parts);
        room.emplace(PathSearch(known, points, parts), self.comm);
    });
    agree(self);
    search_together(*room, self);
    return room->search.take();
}

}  // namespace

bool is_wide(const Options& options, int num_ranks) {
    return std::min(options.num_parts, num_ranks) > options.tuning.central_parts &&
           is_refined(options) && !options.axes.order.is_grouped() && !are_cuts_limited(options);
}

bool reuses_spread(const Cuts& previous, const Options& options, int num_ranks) {
    if (!is_whole(previous)) return true;
    return is_wide(complete(options, num_ranks), num_ranks);
}

Options region_options(const Options& options) {
    const auto most = static_cast<unsigned>(std::min(options.tuning.central_parts, most_regions));
    Options regions = options;
    regions.num_parts =
        options.refine == Refine::exact ? 1 : static_cast<int>(std::bit_floor(most));
    if (regions.num_parts == 1) regions.refine = Refine::none;
    regions.part_sizes.clear();
    for_each_region({0, 0, options.num_parts}, regions.num_parts, [&](const Descent& at) {
        const auto first = static_cast<std::size_t>(at.first_part);
        const auto count = static_cast<std::size_t>(at.num_parts);
        regions.part_sizes.push_back(
            options.part_sizes.empty()
                ? at.num_parts
                : sum_of(std::span(options.part_sizes).subspan(first, count)));
    });
    if (const AxisOrder& order = options.axes.order; order.is_given()) {
        std::vector<int> axes;
        append_axes({0, 0, options.num_parts}, regions.num_parts, order.axes(), axes);
        regions.axes.order = AxisOrder::given(std::move(axes));
    }
    const auto levels = [](int num_parts) {
        return static_cast<double>(std::bit_width(static_cast<unsigned>(num_parts - 1)));
    };
    regions.imbalance_tolerance = std::pow(options.imbalance_tolerance,
                                           levels(regions.num_parts) / levels(options.num_parts));
    return regions;
}

double weight_of(const Report& report) {
    return report.details.all_weights_zero ? static_cast<double>(report.details.num_points)
                                           : report.details.total_weight;
}

void report_parts(double imbalance, double heaviest, double weight, const Options& options,
                  Report& report) {
    report.details.least_imbalance =
        weight > 0 ? std::max(1.0, heaviest / weight * parts_in_all(options)) : 1;
    if (report.details.num_points == 0) return;
    report.imbalance = imbalance;
    report.within_tolerance = imbalance <= options.imbalance_tolerance;
}

std::optional<SpreadParts> read_held(std::optional<SpreadPlaces>& places, const Report& report,
                                     RegionRefinement& refinement, Participant& self) {
    if (!places || report.details.num_points == 0) return std::nullopt;
    return places->read(weight_of(report), report.details.all_weights_zero, refinement.messages(),
                        self);
}

void stay_spread(const Options& options, double heaviest, SpreadParts&& held, Balance& result,
                 Participant& self) {
    agree(self);
    std::ranges::fill(result.parts, static_cast<Part>(mpi::rank_of(self.comm)));
    result.cuts = std::move(held.cuts);
    Report& report = result.report;
    report.kept = true;
    report.part_weights.clear();
    report.details.coincident_cuts = mpi::sum_of(held.num_divided, self.comm);
    report_parts(held.imbalance, heaviest, weight_of(report), options, report);
}

void refine_regions(const Options& options, const Verdict& verdict, const Box& box,
                    const BinnedPoints& binned, RegionRefinement& refinement, Balance& result,
                    Participant& self) {
    const StageScope stage(options.observer, Stage::refinement);
    Report& report = result.report;
    const double weight = weight_of(report);
    // Not counted without points, or for one region.
    std::vector<double> weights = std::exchange(report.part_weights, {});
    self.attempt([&] { weights.resize(static_cast<std::size_t>(result.cuts.num_parts), weight); });
    self.attempt([&] { number_as_in_tree(options.num_parts, result); });
    const Regions regions{std::move(result.cuts), weights, box_together(box, self),
                          report.details.coincident_cuts};
    Refined refined =
        refinement.refine(regions, tree_of(options, verdict, weight, mpi::size_of(self.comm)),
                          binned, result.parts, self);
    agree(self);
    result.cuts = std::move(refined.cuts);
    report_parts(refined.imbalance, verdict.heaviest, weight, options, report);
    report.details.rounds += refined.rounds;
    report.details.coincident_cuts = refined.coincident_cuts;
}

void hold_cuts(const Points& points, const Options& options, Balance& result, Participant& self) {
    Report& report = result.report;
    const bool gets_all = options.cuts == HeldCuts::whole;
    const bool divides =
        options.coincident == Coincident::divide && report.details.coincident_cuts > 0;
    if (!gets_all && !divides) return;
    const StageScope stage(options.observer, Stage::broadcast);
    if (!gets_all) {
        result.cuts = with_cuts_above(points, result.cuts, self);
        return;
    }
    if (!is_whole(result.cuts)) result.cuts = gather_cuts(result.cuts, self);
    if (report.details.num_points == 0) return;
    Points counted = points;
    if (report.details.all_weights_zero) counted.weights = {};
    report.part_weights = part_weights(counted, result.parts, result.cuts.num_parts, self);
}

}  // namespace rrcb
