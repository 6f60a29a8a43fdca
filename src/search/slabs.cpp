#include "search/slabs.hpp"

#include "bisection/bisection.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

std::size_t counts_of(const Descent& at) {
    return static_cast<std::size_t>(at.num_parts) * 2 * bins_a_side;
}

std::size_t counts_below(const Descent& at) {
    return at.is_part() ? 0 : counts_of(at) + counts_below(at.lower()) + counts_below(at.upper());
}

/// Lays slabs from the root of the tree down.
class Layer {
  public:
    Layer(const TargetRule& rule, const Cuts& cuts, std::span<const Bracket> brackets,
          std::span<const double> part_weights, std::span<Slab> slabs)
        : rule_(rule),
          cuts_(cuts),
          brackets_(brackets),
          part_weights_(part_weights),
          slabs_(slabs) {}

    /// `gain` is the weight that cuts above may move into the node or out of it.
    void lay(const Descent& at, int depth, double gain) {
        if (at.is_part()) return;
        const Cut& cut = cuts_.tree[at.node];
        const double value = cut.at[cut.axis];
        slabs_[at.node] = {value, value, Slab::stays, 0};
        const double share = rule_.share_below(at);
        if (!(share > 0 && share < 1)) {
            lay(at.lower(), depth + 1, share > 0 ? gain : 0);
            lay(at.upper(), depth + 1, share > 0 ? 0 : gain);
            return;
        }
        double shift = 0;
        if (gain > 0 || !rule_.may_stay(at, part_weights_)) {
            const double weight = weight_of(at, part_weights_);
            const double below = weight_of(at.lower(), part_weights_);
            const double missing = rule_.target_of(at, weight, below).target - below;
            shift = std::abs(missing) + gain / 2;
            lay_about(value, missing, gain / 2, weight, at, depth);
        }
        lay(at.lower(), depth + 1, shift);
        lay(at.upper(), depth + 1, shift);
    }

    bool is_possible() const { return is_possible_ && weight_ < rule_.counted_weight / 2; }
    const SlabTotals& totals() const { return totals_; }

  private:
    static constexpr double caution = 3;
    /// Extra width of a slab as a share of its bracket, because brackets are estimates.
    static constexpr double floor = 0.25;

    /// Lays a slab for a cut that lacks the weight `missing` below it, give or take `open`.
    void lay_about(double value, double missing, double open, double weight, const Descent& at,
                   int depth) {
        const Bracket& bracket = brackets_[at.node];
        const double in_bracket = expected_error(depth) * weight;
        const double below = (caution * std::max(0.0, -missing) + open) / in_bracket + floor;
        const double above = (caution * std::max(0.0, missing) + open) / in_bracket + floor;
        Slab& slab = slabs_[at.node];
        slab.lower = std::min(value, std::lerp(value, bracket.lower, below));
        slab.upper = std::max(value, std::lerp(value, bracket.upper, above));
        slab.number = totals_.moving++;
        slab.first_count = totals_.counts;
        totals_.counts += counts_of(at);
        weight_ += (below + above) * in_bracket;
        const double width = slab.upper - slab.lower;
        is_possible_ = is_possible_ && width > 0 && std::isfinite(width) && in_bracket > 0;
    }

    const TargetRule& rule_;
    const Cuts& cuts_;
    std::span<const Bracket> brackets_;
    std::span<const double> part_weights_;
    std::span<Slab> slabs_;
    SlabTotals totals_;
    bool is_possible_ = true;
    double weight_ = 0;  ///< expected in all slabs
};

}  // namespace

SlabTotals most_slabs(const Descent& top) {
    return {static_cast<std::size_t>(top.num_parts) - 1, counts_below(top)};
}

SlabTotals lay_slabs(const TargetRule& rule, const Cuts& cuts, std::span<const Bracket> brackets,
                     std::span<const double> part_weights, std::span<Slab> slabs) {
    Layer layer(rule, cuts, brackets, part_weights, slabs);
    layer.lay(root_of(cuts), 0, 0);
    return layer.is_possible() ? layer.totals() : SlabTotals{};
}

double place_in_bin(const Slab& slab, double cut, bool above, int bin, double share) {
    const auto end = [](int k) { return std::ldexp(k % 2 == 0 ? 1.0 : 0.75, -(k / 2)); };
    const double inner = bin + 1 < bins_a_side ? end(bin + 1) : 0;
    const double part = std::lerp(inner, end(bin), share);
    return std::clamp(std::lerp(cut, above ? slab.upper : slab.lower, part), slab.lower,
                      slab.upper);
}

}  // namespace rrcb
