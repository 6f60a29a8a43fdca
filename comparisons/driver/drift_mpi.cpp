#include "drift_mpi.hpp"

#include "counter_random.hpp"

#include <cmath>
#include <numbers>

namespace comparisons {

Drift::Drift(const Workload& workload, double fraction, std::uint64_t seed, MPI_Comm comm)
    : fraction_(fraction),
      dimension_(workload.dimension),
      box_(joined_box(rrcb::bounding_box(workload.points()), comm)) {
    CounterRandom random(seed, 0);
    phase_ = random.uniform();
    for (double& turns : turns_) turns = random.uniform(-1, 1);
}

rrcb::Vector Drift::direction_at(const rrcb::Vector& place) const {
    double turned = phase_;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension_); ++a)
        turned += turns_[a] * place[a];
    const double angle = 2 * std::numbers::pi * turned;
    if (dimension_ < 3) return {std::cos(angle), std::sin(angle), 0};
    const double height = std::sin(angle / 2);
    const double width = std::cos(angle / 2);
    return {width * std::cos(angle), width * std::sin(angle), height};
}

void Drift::move(Workload& workload) const {
    if (!moves()) return;
    const auto d = static_cast<std::size_t>(dimension_);
    for (std::size_t at = 0; at < workload.coordinates.size(); at += d) {
        double* x = &workload.coordinates[at];
        rrcb::Vector place{};
        rrcb::Vector extent{};
        for (std::size_t a = 0; a < d; ++a) {
            extent[a] = box_.upper[a] - box_.lower[a];
            place[a] = extent[a] > 0 ? (x[a] - box_.lower[a]) / extent[a] : 0;
        }
        const rrcb::Vector direction = direction_at(place);
        for (std::size_t a = 0; a < d; ++a) x[a] += fraction_ * extent[a] * direction[a];
    }
}

}  // namespace comparisons
