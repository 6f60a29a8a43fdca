#pragma once

#include "effects/penetrator/penetrator.hpp"

#include <span>
#include <vector>

namespace mpm {

/// Bounds of the friction along a penetrator where shear stress has a limit.
///
/// The points that touch a surface are too few, and stretched too far, to tell its area. The body
/// tells it: bands of equal height divide its surface. The ratio of friction to normal force is at
/// most (mean limit * area of the band) / mean normal force on it. Means are over the last steps.
template <int D>
class FrictionBands {
  public:
    /// `share`: part of the body in the domain. `height`: of a band, about, m.
    FrictionBands(const Penetrator<D>& body, double height, double share)
        : length_(body.length), areas_(static_cast<std::size_t>(std::ceil(body.length / height))) {
        for (std::size_t k = 0; k < areas_.size(); ++k)
            areas_[k] = share * (body.area_below(edge(k + 1)) - body.area_below(edge(k)));
        sums_.resize(2 * areas_.size());
        means_ = sums_;
    }

    /// Adds the normal force on a point, N, at a height above the tip, m, with its limit of shear
    /// stress, Pa.
    void add(double height, double normal_force, double limit) {
        const std::size_t k = band_at(height);
        sums_[2 * k] += normal_force;
        sums_[2 * k + 1] += normal_force * limit;
    }

    /// Largest ratio of friction to normal force at a height above the tip, at most `friction`.
    double most_at(double height, double friction) const {
        const std::size_t k = band_at(height);
        const double normal = means_[2 * k], allowed = areas_[k] * means_[2 * k + 1];
        return allowed < friction * normal * normal ? allowed / (normal * normal) : friction;
    }

    /// Sums of this rank in the step. The caller adds them up over the ranks.
    std::span<const double> sums() const { return sums_; }

    /// Takes the sums over all ranks into the means with a weight and begins a step.
    void settle(std::span<const double> sums, double weight) {
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            means_[i] += weight * (sums[i] - means_[i]);
            sums_[i] = 0;
        }
    }

    /// Means between steps, and the same taken up again.
    std::span<const double> means() const { return means_; }
    void resume(std::span<const double> means) { means_.assign(means.begin(), means.end()); }

  private:
    double edge(std::size_t k) const {
        return length_ * static_cast<double>(k) / static_cast<double>(areas_.size());
    }
    std::size_t band_at(double height) const {
        const double place = std::max(height, 0.0) / length_ * static_cast<double>(areas_.size());
        return std::min(static_cast<std::size_t>(place), areas_.size() - 1);
    }

    double length_;
    std::vector<double> areas_;         ///< m^2; in two dimensions m
    std::vector<double> sums_, means_;  ///< by band: normal force, the same times the limit
};

}  // namespace mpm
