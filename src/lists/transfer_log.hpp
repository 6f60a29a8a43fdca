#pragma once

#include "collective/stamp_access.hpp"

#include <rrcb/ghosts.hpp>
#include <rrcb/plan.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>

namespace rrcb {

/// Returns a number that is larger than all earlier ones in this process.
inline std::uint64_t next_stamp() {
    static std::atomic<std::uint64_t> stamp{0};
    return ++stamp;
}

/// The latest transfers of points with a communicator, as seen by this rank.
///
/// A transfer may belong to any points, so only the number of points links it to ghosts. Ghosts are
/// stale if a plan that was made after them has moved as many points as they were made for, unless
/// an older plan has brought this number of points back later.
class TransferLog {
  public:
    /// Notes a transfer. Every rank must make the same calls. `is_like_before` means that the
    /// result on this rank may have the same hash as the points before.
    void add(const Plan& plan, bool moves, bool is_like_before) {
        ++number_;
        const std::uint64_t stamp = detail::StampAccess::points(plan.stamp);
        if (!moves || stamp == 0) return;
        auto place = std::ranges::find(transfers_, stamp, &Transfer::plan);
        if (place == transfers_.end())
            place = std::ranges::min_element(transfers_, {}, &Transfer::number);
        const bool was_like_before = place->plan == stamp && place->is_like_before;
        *place = {stamp, number_, plan.num_points,
                  plan.num_points - plan.export_indices.size() + plan.import_ranks.size(),
                  is_like_before || was_like_before};
    }

    /// Returns the number of transfers, the same on every rank.
    std::uint64_t number() const { return number_; }

    /// Returns true if a transfer led to this number of points, and their hash may be the same as
    /// before it.
    bool are_like_before(LocalIndex num_points) const {
        return std::ranges::any_of(transfers_, [&](const Transfer& transfer) {
            return transfer.is_like_before && transfer.after == num_points;
        });
    }

    /// Returns the number of the latest transfer that made the ghosts stale, or 0.
    std::uint64_t overtaking(const GhostPlan& ghosts) const {
        const std::uint64_t stamp = detail::StampAccess::points(ghosts.stamp);
        std::uint64_t back = 0;
        std::uint64_t taken = 0;
        for (const Transfer& transfer : transfers_) {
            if (transfer.plan < stamp && transfer.after == ghosts.num_points)
                back = std::max(back, transfer.number);
            if (transfer.plan > stamp && transfer.before == ghosts.num_points)
                taken = std::max(taken, transfer.number);
        }
        return taken > back ? taken : 0;
    }

  private:
    struct Transfer {
        std::uint64_t plan = 0;    ///< stamp of its plan
        std::uint64_t number = 0;  ///< among all transfers, the same on every rank
        LocalIndex before = 0;
        LocalIndex after = 0;
        bool is_like_before = false;
    };

    std::uint64_t number_ = 0;
    std::array<Transfer, 16> transfers_{};
};

}  // namespace rrcb
