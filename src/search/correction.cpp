#include "arithmetic/part_share.hpp"
#include "search/slabs.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

class Corrector {
  public:
    Corrector(const TargetRule& rule, const Cuts& cuts, std::span<const Slab> slabs,
              std::span<double> part_weights, std::span<const double> counts,
              std::span<double> values)
        : rule_(rule),
          cuts_(cuts),
          slabs_(slabs),
          part_weights_(part_weights),
          counts_(counts),
          values_(values) {}

    /// Corrects the cuts at and below a node; `is_changed` if a cut above has moved.
    void run(const Descent& at, bool is_changed) {
        if (at.is_part()) return;
        const Slab& slab = slabs_[at.node];
        if (slab.moves()) {
            const Cut& cut = cuts_.tree[at.node];
            double& value = values_[slab.number];
            value = cut.at[cut.axis];
            if (is_changed || !rule_.may_stay(at, part_weights_)) {
                value = move(at, slab, value);
                is_changed = true;
            }
        }
        run(at.lower(), is_changed);
        run(at.upper(), is_changed);
    }

  private:
    /// Moves a cut until the weight below it meets its target; returns the new position.
    double move(const Descent& at, const Slab& slab, double cut) {
        const double below = weight_of(at.lower(), part_weights_);
        const double weight = below + weight_of(at.upper(), part_weights_);
        const double missing = rule_.target_of(at, weight, below).target - below;
        const bool above = missing > 0;
        double left = std::abs(missing);
        if (left == 0) return cut;
        for (int bin = bins_a_side - 1; bin >= 0; --bin) {
            const auto counts = bin_in(counts_, at, slab, above, bin);
            const double in_bin = sum_of(lower_of(counts, at));
            const double share = in_bin > left ? left / in_bin : 1;
            bring(at, counts, above ? share : -share);
            if (in_bin >= left) return place_in_bin(slab, cut, above, bin, share);
            left -= in_bin;
        }
        return above ? slab.upper : slab.lower;
    }

    static std::span<const double> lower_of(std::span<const double> counts, const Descent& at) {
        return counts.first(at.lower().num_parts);
    }

    /// Moves a share of a bin below the cut of a node, or above it if the share is negative.
    void bring(const Descent& at, std::span<const double> counts, double share) {
        const std::size_t num_below = lower_of(counts, at).size();
        for (std::size_t k = 0; k < counts.size(); ++k) {
            double& weight = part_weights_[at.first_part + k];
            weight = std::max(0.0, weight + (k < num_below ? share : -share) * counts[k]);
        }
    }

    const TargetRule& rule_;
    const Cuts& cuts_;
    std::span<const Slab> slabs_;
    std::span<double> part_weights_;
    std::span<const double> counts_;
    std::span<double> values_;
};

}  // namespace

void correct(const TargetRule& rule, const Cuts& cuts, std::span<const Slab> slabs,
             std::span<double> part_weights, std::span<const double> counts,
             std::span<double> values) {
    Corrector(rule, cuts, slabs, part_weights, counts, values).run(root_of(cuts), false);
}

}  // namespace rrcb
