#include "controller/waste_history.hpp"

#include <algorithm>
#include <limits>

namespace rrcb {

WasteHistory::Stretch WasteHistory::joined(const Stretch& a, const Stretch& b) {
    return {a.work + b.work, a.waste + b.waste, std::max(a.highest, b.highest),
            std::min(a.lowest, b.lowest)};
}

void WasteHistory::add(double excess, double work) {
    const Stretch step{work, excess * work, excess, excess};
    total_ = joined(total_, step);
    Stretch& last = stretches_[num_full_];
    last = steps_in_last_ == 0 ? step : joined(last, step);
    if (++steps_in_last_ < steps_in_each_) return;
    steps_in_last_ = 0;
    if (++num_full_ == stretches_.size()) halve();
}

void WasteHistory::halve() {
    num_full_ /= 2;
    for (std::size_t i = 0; i < num_full_; ++i)
        stretches_[i] = joined(stretches_[2 * i], stretches_[2 * i + 1]);
    steps_in_each_ *= 2;
}

double WasteHistory::mean_since(double level) const {
    std::size_t i = 0;
    while (i < num_stretches() && stretches_[i].highest < level) ++i;
    double work = 0;
    double waste = 0;
    for (; i < num_stretches(); ++i) {
        work += stretches_[i].work;
        waste += stretches_[i].waste;
    }
    return work > 0 ? waste / work : level;
}

double WasteHistory::lasting_waste(double floor) const {
    std::size_t i = num_stretches();
    double lasting = std::numeric_limits<double>::infinity();
    double waste = 0;
    while (i > 0 && lasting > floor) {
        const Stretch& stretch = stretches_[--i];
        // invariant: no stretch from here on was below `lasting`
        lasting = std::min(lasting, stretch.lowest);
        waste += std::max(0.0, lasting - floor) * stretch.work;
    }
    return waste;
}

}  // namespace rrcb
