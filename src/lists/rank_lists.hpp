#pragma once

#include <rrcb/ghosts.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

/// Lists of points for some ranks, with their shifts in a periodic box.
class RankLists {
  public:
    /// Makes empty lists for ranks, which must ascend. Throws std::bad_alloc.
    RankLists(std::span<const int> ranks, bool has_shifts) : has_shifts_(has_shifts) {
        for (const int rank : ranks) lists_.push_back({rank});
    }

    /// Empties the lists but keeps their memory.
    void clear() {
        for (List& list : lists_) {
            list.points.clear();
            list.shifts.clear();
        }
    }

    /// Sets the point, or the image of it, to be added next. Points must come in ascending order.
    void begin(LocalIndex point, const Shift& shift) {
        ++number_;
        point_ = point;
        shift_ = shift;
    }

    /// Adds the point to the list of a rank, unless it is there already.
    void add(std::int32_t slot) {
        List& list = lists_[slot];
        if (list.latest == number_) return;
        list.latest = number_;
        list.points.push_back(point_);
        if (has_shifts_) list.shifts.push_back(shift_);
    }

    int rank_of(std::int32_t slot) const { return lists_[slot].rank; }

    /// Writes all lists that are not empty into the plan, one after the other.
    void write(GhostPlan& plan) const {
        plan.send.clear();
        plan.send_indices.clear();
        plan.shifts.clear();
        LocalIndex number = 0;
        for (const List& list : lists_) number += list.points.size();
        plan.send_indices.reserve(number);
        if (has_shifts_) plan.shifts.reserve(number);
        for (const List& list : lists_) {
            if (list.points.empty()) continue;
            plan.send.push_back({list.rank, list.points.size()});
            plan.send_indices.insert(plan.send_indices.end(), list.points.begin(),
                                     list.points.end());
            plan.shifts.insert(plan.shifts.end(), list.shifts.begin(), list.shifts.end());
        }
    }

  private:
    struct List {
        int rank;
        std::uint64_t latest = 0;  ///< number of the point or image added last
        std::vector<LocalIndex> points{};
        std::vector<Shift> shifts{};
    };

    bool has_shifts_;
    std::vector<List> lists_{};
    std::uint64_t number_ = 0;
    LocalIndex point_ = 0;
    Shift shift_{};
};

}  // namespace rrcb
