#include "controller/latest_steps.hpp"

#include <algorithm>

namespace rrcb {

void LatestSteps::add(const Waste& step) {
    ++count_;
    Waste block = step;
    for (std::size_t k = 0; k < num_lengths; ++k) {
        auto& [latest, earlier, first] = blocks_[k];
        first = earlier;
        earlier = latest;
        latest = block;
        // invariant: two blocks make one of the next length when their number is even
        if ((count_ >> k) % 2 == 1) return;
        block = earlier + latest;
    }
}

double LatestSteps::lasting(std::size_t k) const {
    const auto& [latest, earlier, first] = blocks_[k];
    return std::min({latest.excess(), earlier.excess(), first.excess()});
}

double LatestSteps::lasting() const {
    double excess = 0;
    for (std::size_t k = 0; has(k); ++k) excess = std::max(excess, lasting(k));
    return excess;
}

}  // namespace rrcb
