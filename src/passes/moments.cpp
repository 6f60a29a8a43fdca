#include "options/rejection.hpp"
#include "options/validation.hpp"
#include "passes/cell_moments.hpp"

#include <rrcb/method/moments.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rrcb {

namespace {

/// Returns the mean of two groups, from the mean and the share of each; between `a` and `b`
/// whatever the rounding.
double joint_mean(double a, double share_a, double b, double share_b) {
    // With opposite signs the difference may overflow; with the same sign it is exact enough.
    const double mean =
        std::signbit(a) != std::signbit(b) ? share_a * a + share_b * b : a + share_b * (b - a);
    return std::clamp(mean, std::min(a, b), std::max(a, b));
}

}  // namespace

Moments merge(const Moments& a, const Moments& b) {
    if (a.weight == 0 && b.weight == 0 && a.count > 0 && b.count > 0) {
        Moments joint = merge({a.count, static_cast<double>(a.count), a.mean, a.deviation},
                              {b.count, static_cast<double>(b.count), b.mean, b.deviation});
        joint.weight = 0;
        return joint;
    }
    if (!(b.weight > 0)) return {a.count + b.count, a.weight, a.mean, a.deviation};
    if (!(a.weight > 0)) return {a.count + b.count, b.weight, b.mean, b.deviation};
    Moments joint{a.count + b.count, a.weight + b.weight, {}, {}};
    const double share_a = a.weight / joint.weight;
    const double share_b = b.weight / joint.weight;
    for (std::size_t axis = 0; axis < max_dimension; ++axis) {
        const double half_distance = b.mean[axis] / 2 - a.mean[axis] / 2;
        joint.mean[axis] = joint_mean(a.mean[axis], share_a, b.mean[axis], share_b);
        const double deviation = std::hypot(std::sqrt(share_a) * a.deviation[axis],
                                            std::sqrt(share_b) * b.deviation[axis],
                                            2 * std::sqrt(share_a * share_b) * half_distance);
        // Rounding may lead beyond the largest double.
        joint.deviation[axis] = std::min(deviation, std::numeric_limits<double>::max());
    }
    return joint;
}

std::vector<CellMoments> cell_moments(const Points& points, const SupportMesh& mesh) {
    check_arrays(points);
    require(points.dimension == mesh.dimension, "the mesh must have the dimension of the points");
    return locally([&] { return moments_of_cells(points, mesh); });
}

}  // namespace rrcb
