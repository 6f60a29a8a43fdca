#include "gather/better_mpi.hpp"

#include "collective/communicator.hpp"
#include "gather/decision_mpi.hpp"
#include "gather/keeping.hpp"
#include "passes/near_points.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rrcb {

namespace {

/// Returns the number of all points near cuts: a pass over the points. Collective.
std::int64_t num_near(const Cuts& cuts, const Points& points, double reach,
                      const Participant& self) {
    const double share = near_share(cuts, points, reach, points.count).by_count;
    std::int64_t number = std::llround(share * static_cast<double>(points.count));
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPI_INT64_T, MPI_SUM, self.comm),
               "MPI_Allreduce");
    return number;
}

}  // namespace

bool may_save_ghosts(const Options& options, const NearCuts& chosen, double share_now) {
    constexpr double more = 1.15;
    const AxisOrder& order = options.axes.order;
    const bool are_free = !order.is_longest() && !order.is_given() && !order.is_grouped();
    return are_free && counts_earlier_parts(options) && chosen.reach > 0 && chosen.share > 0 &&
           share_now > more * chosen.share;
}

double reference(const NearCuts& chosen, double share_now, bool was_compared, bool were_moved) {
    constexpr double sampling = 1.1;  // the share of a sample varies
    constexpr double ageing = 0.97;   // other axes may have become better
    const bool is_new = was_compared || !(chosen.share > 0);
    const double share = is_new ? share_now : std::min(chosen.share, sampling * share_now);
    return were_moved ? ageing * share : share;
}

Balance better(Balance&& reused, Balance&& anew, const Points& points, const Options& options,
               bool compares_ghosts, const Participant& self) {
    constexpr double fewer = 0.92;
    const double tolerance = options.imbalance_tolerance;
    const double reach = anew.cuts.near.reach;
    bool gains = is_worth_moving(reused.report.imbalance, anew.report.imbalance, options);
    if (compares_ghosts) {
        const std::int64_t before = num_near(reused.cuts, points, reach, self);
        const std::int64_t after = num_near(anew.cuts, points, reach, self);
        const bool is_even =
            std::islessequal(anew.report.imbalance, std::max(tolerance, reused.report.imbalance));
        gains =
            gains || (is_even && static_cast<double>(after) < fewer * static_cast<double>(before));
    }
    const int rounds = reused.report.details.rounds + anew.report.details.rounds;
    const double near_before = reused.report.details.near_before;
    Balance best = gains ? std::move(anew) : std::move(reused);
    best.report.details.rounds = rounds;
    best.report.details.near_before = near_before;
    return best;
}

}  // namespace rrcb
