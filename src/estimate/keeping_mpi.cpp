#include "estimate/keeping_mpi.hpp"

#include "arithmetic/part_share.hpp"
#include "bisection/bisection.hpp"
#include "collective/communicator.hpp"
#include "cuts/tree.hpp"
#include "estimate/decision_mpi.hpp"
#include "options/call_kind.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace rrcb {

namespace {

/// Returns how near a position is to the cuts above it in the tree. Each cut adds 1 if the position
/// is on it, less with growing distance, and 0 beyond `reach`. Because the weight decreases
/// gradually, the sum over points in regular layers changes little while a cut moves between two
/// layers.
double nearness(const Cuts& cuts, const Vector& position, double reach) {
    double sum = 0;
    for (Descent at = root_of(cuts); !at.is_part();) {
        const Cut& cut = cuts.tree[at.node];
        const double distance = std::abs(position[cut.axis] - cut.at[cut.axis]) / reach;
        if (distance < 1) sum += (1 - distance * distance) * (1 - distance * distance);
        at = is_above(cut, position, cuts.dimension) ? at.upper() : at.lower();
    }
    return sum;
}

/// Returns the reach for has_far_fewer_near(): a few spacings of points that fill their box. It
/// does not depend on which ranks hold the points.
double wide_reach(const Box& box, std::int64_t num_points) {
    constexpr double spacings = 6;
    double sum = 0;
    int num_axes = 0;
    for (std::size_t a = 0; a < max_dimension; ++a) {
        const double half = box.upper[a] / 2 - box.lower[a] / 2;
        if (!(half > 0)) continue;
        sum += std::log(half);
        ++num_axes;
    }
    if (num_axes == 0) return 0;
    return 2 * spacings * std::exp((sum - std::log(static_cast<double>(num_points))) / num_axes);
}

/// Returns true if far fewer points are near the cuts `turned` than near `held`. Collective: one
/// reduction.
bool has_far_fewer_near(const Cuts& turned, const Cuts& held, double reach, PointPasses& points,
                        Participant& self) {
    constexpr double enough = 0.85;
    constexpr double digits = 1024;
    std::array<std::int64_t, 2> near{};
    self.attempt([&] {
        const PointSample sample =
            points.sample(std::max(256, (1 << 14) / mpi::size_of(self.comm)));
        const auto size = static_cast<double>(sample.positions.size());
        const auto count = [&](const Cuts& cuts) {
            double sum = 0;
            for (const Vector& position : sample.positions) sum += nearness(cuts, position, reach);
            return std::llround(digits * sum / size * static_cast<double>(points.count()));
        };
        if (size > 0) near = {count(turned), count(held)};
    });
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, near.data(), 2, MPI_INT64_T, MPI_SUM, self.comm),
               "MPI_Allreduce");
    return static_cast<double>(near[0]) < enough * static_cast<double>(near[1]);
}

}  // namespace

bool turns(Decision& decision, const Cuts& held, PointPasses& points, Participant& self) {
    Verdict& verdict = decision.verdict;
    const double reach = wide_reach(verdict.box, verdict.num_points);
    const bool turns = has_far_fewer_near(decision.turned.cuts, held, reach, points, self);
    if (turns) verdict.kept_imbalance = not_kept;
    return turns;
}

bool reads_kept_tree(const Options& options, int num_ranks) {
    // The same limit up to which rank 0 divides by default.
    return num_ranks > 1 && num_ranks <= ExpertOptions{}.max_root_parts &&
           options.num_parts == num_ranks && !are_cuts_limited(options);
}

bool keeps_at_once(double kept, const Options& options) {
    return options.refine != Refine::exact && kept - 1 <= (options.imbalance_tolerance - 1) / 10;
}

namespace {

/// Weight of a node, and how far its cut is from its target: the excess weight of the heavier side
/// times the share of the other side.
struct NodeWeight {
    double all;
    double excess;
};

NodeWeight weight_at(const Descent& at, std::span<const double> part_weights,
                     const Options& options) {
    const auto of_parts = [&](std::span<const double> all) {
        return all.subspan(at.first_part, at.num_parts);
    };
    const double share = share_below(of_parts(options.part_sizes), at.lower_parts());
    const double all = sum_of(of_parts(part_weights));
    const double missing = share * all - sum_of(of_parts(part_weights).first(at.lower_parts()));
    return {all, missing > 0 ? share * missing : (share - 1) * missing};
}

}  // namespace

bool are_as_exact(std::span<const double> kept, std::span<const double> found, const Cuts& cuts,
                  double heaviest, const Options& options) {
    constexpr double rounding = 1e-12;
    if (std::ranges::count(kept, 0.0) > std::ranges::count(found, 0.0)) return false;
    if (imbalance(kept, options.part_sizes) > imbalance(found, options.part_sizes) * (1 + rounding))
        return false;
    const auto is_as_exact = [&](const auto& self, const Descent& at) -> bool {
        if (at.is_part()) return true;
        const NodeWeight now = weight_at(at, kept, options);
        const NodeWeight then = weight_at(at, found, options);
        // If a cut divides coincident points, the order of the points limits how near the target it
        // can come.
        const double of_order = cuts.tree[at.node].divides != 0 ? heaviest / 2 : 0;
        return now.excess <= then.excess + of_order + rounding * std::max(now.all, then.all) &&
               self(self, at.lower()) && self(self, at.upper());
    };
    return is_as_exact(is_as_exact, root_of(cuts));
}

bool is_worth_moving(double kept, double offered, const Options& options) {
    // `offered` is NaN if nothing was counted; these comparisons then raise no floating-point
    // exception.
    constexpr double rounding = 1e-12;
    const double tolerance = options.imbalance_tolerance;
    if (kept > tolerance && std::islessequal(offered, tolerance)) return true;
    const bool gains = std::isgreater(kept - offered, std::max((tolerance - 1) / 20, rounding));
    const bool is_half = std::islessequal(offered - 1, (kept - 1) / 2);
    // A search finds the best imbalance, so any gain counts. The imbalance of an estimate varies by
    // chance.
    return gains && (is_half || (kept > tolerance && is_refined(options)));
}

bool is_worth_moving(const Report& kept, const Report& offered, const Options& options) {
    constexpr double rounding = 1e-12;
    const auto num_empty = [](const Report& report) {
        return std::ranges::count(report.part_weights, 0.0);
    };
    const auto& sizes = options.part_sizes;
    const bool fills =
        std::ranges::adjacent_find(sizes, std::ranges::not_equal_to{}) == sizes.end() &&
        num_empty(offered) < num_empty(kept);
    return is_worth_moving(kept.imbalance, offered.imbalance, options) ||
           (fills && std::islessequal(offered.imbalance, kept.imbalance * (1 + rounding)));
}

bool keeps_after_all(const Decision& decision, const Options& options, const Balance& made) {
    const Verdict& verdict = decision.verdict;
    const Report& report = made.report;
    if (options.refine == Refine::exact)
        return are_as_exact(decision.part_weights, report.part_weights, made.cuts,
                            verdict.balanced_heaviest(), options);
    return !is_worth_moving(verdict.kept_imbalance, report.imbalance, options);
}

}  // namespace rrcb
