#pragma once

#include "passes/open_points.hpp"

#include <map>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Open points as copies on the host, which any passes can collect.
class CollectedPoints final : public OpenPoints {
  public:
    /// Collects points as described at PointPasses::open(). Borrows all arguments except the
    /// intervals.
    CollectedPoints(PointPasses& points, const Cuts& cuts, std::span<const Bracket> intervals,
                    bool has_parts, OpenMemory& memory);

    bool is_empty(const Descent& at) const override { return waiting_at(at).empty(); }
    double weight_at(const Descent& at) const override;
    Total total_in(const Descent& at) const override;
    void count(const Descent& at, int axis, const Bins& bins, const HistogramLayout& layout,
               std::span<double> histogram) const override;
    void count_sums(const Descent& at, int axis, const Bins& bins, const HistogramLayout& layout,
                    std::span<double> sums) const override;
    void choose(const Descent& at, int axis, const Bracket& interval) override;
    void take(const Descent& at, std::vector<double>& records) const override;
    PointsInLot lot(const Descent& at, const Cut& cut) const override;
    Gap gap(const Descent& at, const Cut& cut) override;
    void cut(const Descent& at, const Cut& cut, const Lot& lot) override;
    void widen(std::span<const WiderNode> nodes) override;
    std::vector<double> settle() override;

  private:
    /// What a point needs of a node on its way down, in few bytes.
    struct Step {
        Bracket interval{};
        int axis = 0;
        int lower_parts = 0;
    };
    /// Identifies a node or a part: its first part and its number of parts.
    using Place = std::pair<Part, int>;
    static Place place_of(const Descent& at) { return {at.first_part, at.num_parts}; }

    bool has_cuts() const { return cuts_ != nullptr; }
    void add_steps(const Descent& at, std::span<const Bracket> intervals);
    const Entries& waiting_at(const Descent& at) const;
    const Entries& candidates_at(const Descent& at) const;
    std::span<const Entries> waiting_in(const Descent& at) const {
        return std::span(waiting_).subspan(at.node, static_cast<std::size_t>(at.num_parts) - 1);
    }
    Entries take_at(const Descent& at);
    std::vector<char> sides_of(const Entries& entries, const Cut& cut, const Lot& lot) const;
    void send(const Descent& from, const Entries& entries);
    void send(const Descent& from, LocalIndex i);
    void settle(LocalIndex i, Part part);
    void settle_waiting(const Descent& at);
    Total total_of(Part part) const;
    std::vector<Entries> take_below(std::span<const WiderNode> nodes);
    void narrow(const Cut& cut, const Entries& entries, Gap& gap) const;
    void narrow_by_parts(const Descent& at, const Cut& cut, Gap& gap);

    PointPasses& points_;
    OpenMemory& memory_;  ///< takes the memory of the points back at the end
    Collected collected_;
    std::vector<Part> parts_;  ///< parts of the collected points; no_part while they wait
    int num_parts_;
    const Cuts* cuts_ = nullptr;       ///< null in a tree without cuts
    std::vector<Step> steps_;          ///< one for each node of the cuts
    std::vector<Total> arrived_;       ///< totals of the collected points in each part
    std::vector<Entries> waiting_;     ///< points at each node of the cuts; used if there are cuts
    std::map<Place, Entries> held_;    ///< points at nodes and parts of a tree without cuts
    std::map<Place, Entries> chosen_;  ///< candidates chosen at nodes
    std::vector<Box> part_boxes_;  ///< boxes of the settled points of each part; empty until a gap
                                   ///< needs them
};

}  // namespace rrcb
