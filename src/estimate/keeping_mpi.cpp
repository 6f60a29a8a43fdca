#include "estimate/keeping_mpi.hpp"

#include "collective/communicator.hpp"
#include "estimate/decision_mpi.hpp"
#include "estimate/earlier_cuts.hpp"
#include "options/call_kind.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace rrcb {

namespace {

/// Returns a rank's number of points near cuts.
std::int64_t num_near(const Cuts& cuts, const PointSample& sample, LocalIndex count, double reach) {
    return std::llround(near_share(cuts, sample, reach).by_count * static_cast<double>(count));
}

}  // namespace

bool saves_ghosts(const Cuts& reused, const Cuts& anew, const PointSample& sample, LocalIndex count,
                  const Participant& self) {
    constexpr double fewer = 0.94;
    const double reach = anew.near.reach;
    std::array<std::int64_t, 2> near{num_near(reused, sample, count, reach),
                                     num_near(anew, sample, count, reach)};
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, near.data(), 2, MPI_INT64_T, MPI_SUM, self.comm),
               "MPI_Allreduce");
    const auto [before, after] = near;
    return static_cast<double>(after) < fewer * static_cast<double>(before);
}

bool reads_kept_tree(const Options& options, int num_ranks) {
    // As many as rank 0 divides by default.
    return num_ranks > 1 && num_ranks <= Tuning{}.central_parts && options.num_parts == num_ranks &&
           options.refine != Refine::exact && !are_cuts_limited(options);
}

bool keeps_at_once(double kept, double tolerance) {
    return kept - 1 <= (tolerance - 1) / 10;
}

bool is_worth_moving(double kept, double offered, const Options& options) {
    // NaN, if nothing was counted, raises no exception in these comparisons.
    constexpr double rounding = 1e-12;
    const double tolerance = options.imbalance_tolerance;
    if (kept > tolerance && std::islessequal(offered, tolerance)) return true;
    const bool gains = std::isgreater(kept - offered, std::max((tolerance - 1) / 20, rounding));
    const bool is_half = std::islessequal(offered - 1, (kept - 1) / 2);
    // A search finds the best imbalance. An estimate depends on chance.
    return gains && (is_half || (kept > tolerance && is_refined(options)));
}

bool may_be_poor(double imbalance, double least, const Options& options) {
    constexpr double factor = 1.25;
    return is_refined(options) && !are_cuts_limited(options) &&
           std::isgreater(imbalance, factor * std::max(options.imbalance_tolerance, least));
}

bool may_save_ghosts(const Options& options, const NearCuts& chosen, double share_now) {
    constexpr double more = 1.15;
    const AxisOrder& order = options.axes.order;
    const bool are_free = !order.is_longest() && !order.is_given() && !order.is_grouped();
    return are_free && !are_cuts_limited(options) && chosen.reach > 0 && chosen.share > 0 &&
           share_now > more * chosen.share;
}

double reference(double chosen, double share_now, bool are_moved) {
    const double share = chosen > 0 ? std::min(chosen, share_now) : share_now;
    return are_moved ? 0.95 * share : share;
}

Balance better(Balance&& reused, std::span<const Part> parts, Balance&& anew, PointPasses& points,
               const Options& options, const PointSample* sample, Participant& self) {
    const double kept = reused.report.imbalance;
    const double offered = anew.report.imbalance;
    const bool is_even = std::islessequal(offered, std::max(options.imbalance_tolerance, kept));
    bool gains = may_be_poor(kept, reused.report.details.least_imbalance, options) &&
                 is_worth_moving(kept, offered, options);
    if (sample)
        gains = (saves_ghosts(reused.cuts, anew.cuts, *sample, points.count(), self) && is_even) ||
                gains;
    if (!gains) self.attempt([&] { points.set_parts(parts); });
    const int rounds = reused.report.details.rounds + anew.report.details.rounds;
    const double near_before = reused.report.details.near_before;
    Balance best = gains ? std::move(anew) : std::move(reused);
    best.report.details.rounds = rounds;
    best.report.details.near_before = near_before;
    return best;
}

}  // namespace rrcb
