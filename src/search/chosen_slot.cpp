#include "search/chosen_slot.hpp"

namespace rrcb {

Chosen choose(const CutTarget& target, std::span<const double> weights,
              std::span<const double> counts) {
    Chosen chosen{0, target.base, target.base_count};
    const int last = static_cast<int>(weights.size()) - 1;
    // The base and all slots before this one weigh less than the target. So the target is in this
    // slot, or by round-off behind all slots, and the last one is taken. With few points, their
    // number may move the cut to another slot.
    while (chosen.slot < last) {
        const double next = chosen.below + weights[chosen.slot];
        const auto count = chosen.count + static_cast<GlobalCount>(counts[chosen.slot]);
        const bool is_enough = next >= target.target && count >= target.counts.least;
        if (is_enough || count >= target.counts.most) break;
        chosen = {chosen.slot + 1, next, count};
    }
    return chosen;
}

EdgeErrors errors_at(const Chosen& chosen, double weight, double count, const CutTarget& target) {
    return {target.excess(chosen.below, chosen.count),
            target.excess(chosen.below + weight, chosen.count + static_cast<GlobalCount>(count))};
}

}  // namespace rrcb
