#include "controller/cycle.hpp"

#include <algorithm>
#include <limits>

namespace rrcb {

void Cycle::add(const Waste& step) {
    ++count_;
    total_ = total_ + step;
    if (count_ == std::size_t{1} << num_first_) first_[num_first_++] = total_;
}

void Cycle::remember(const Cycle& later, double excess_at_end) {
    const double mean = later.total_.work / static_cast<double>(later.count_);
    for (std::size_t k = 0; k < std::max(num_first_, later.num_first_); ++k) {
        const double beyond = mean * (steps_of(k) - static_cast<double>(later.count_));
        const Waste extended = later.total_ + Waste{excess_at_end * beyond, beyond};
        first_[k] = 0.5 * first_[k] + (k < later.num_first_ ? later.first_[k] : extended);
    }
    num_first_ = std::max(num_first_, later.num_first_);
}

double Cycle::gain(double excess, double horizon) const {
    double most = 0;
    for (std::size_t k = 0; k < num_first_ && steps_of(k) <= horizon; ++k)
        most = std::max(most, steps_of(k) * (excess - first_[k].excess()));
    const auto count = static_cast<double>(count_);
    if (count <= horizon) most = std::max(most, count * (excess - total_.excess()));
    return most;
}

double Cycle::least_excess() const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 2; k < num_first_; ++k) least = std::min(least, first_[k].excess());
    return least;
}

void LatestSteps::add(const Waste& step) {
    ++count_;
    Waste block = step;
    for (std::size_t k = 0; k < num_lengths; ++k) {
        auto& [latest, earlier, first] = blocks_[k];
        first = earlier;
        earlier = latest;
        latest = block;
        // Two consecutive blocks are joined to one of twice the length when the number of blocks
        // becomes even.
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
