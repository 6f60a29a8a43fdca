#include "c/balancer.hpp"
#include "c/handle_mpi.hpp"
#include "lists/duplicated_mpi.hpp"

#include <rrcb/part_sizes.hpp>

#include <algorithm>
#include <span>

namespace {

using rrcb::CallName;
using rrcb::Participant;
using rrcb::c::guarded;
using rrcb::c::guarded_together;
using rrcb::c::require;
using rrcb::c::view;

/// Checks the arguments of a measure, and returns the weights of the parts.
std::span<const double> weights_of_parts(size_t num_parts, const double* part_weights,
                                         const double* result) {
    rrcb::c::require_array(num_parts, part_weights,
                           "part_weights, or an array of one for each part,");
    require(result, "the result");
    return view(part_weights, num_parts);
}

/// Checks the arguments of a measure, and returns the points.
rrcb::Points points_in_parts(const rrcb_points* given, const int32_t* parts, const double* result) {
    const rrcb::Points points = rrcb::c::points_of(given);
    rrcb::c::require_array(points.count, parts, "parts");
    require(result, "the result");
    return points;
}

}  // namespace

int rrcb_imbalance(size_t num_parts, const double* part_weights, const double* part_sizes,
                   double* imbalance) {
    return guarded([&] {
        const auto weights = weights_of_parts(num_parts, part_weights, imbalance);
        *imbalance = rrcb::imbalance(weights, view(part_sizes, num_parts));
    });
}

int rrcb_balanced_sizes(size_t num_parts, const double* loads, const double* part_sizes,
                        double* sizes) {
    return guarded([&] {
        const auto of_parts = weights_of_parts(num_parts, loads, sizes);
        std::ranges::copy(rrcb::balanced_sizes(of_parts, view(part_sizes, num_parts)), sizes);
    });
}

int rrcb_part_weights(const rrcb_balancer* balancer, const rrcb_points* points,
                      const int32_t* parts, size_t num_parts, double* part_weights) {
    return guarded_together(
        CallName::part_weights, balancer, [&](const auto& own, Participant& self) {
            rrcb::Points given;
            self.attempt([&] {
                rrcb::c::require_parts(own, num_parts);
                given = points_in_parts(points, parts, part_weights);
            });
            const auto weights =
                rrcb::part_weights(given, view(parts, given.count), own.cuts.num_parts, self);
            std::ranges::copy(weights, part_weights);
        });
}

int rrcb_moved_fraction(const rrcb_balancer* balancer, const rrcb_points* points,
                        const int32_t* parts, double* fraction) {
    return guarded_together(
        CallName::moved_fraction, balancer, [&](const auto& own, Participant& self) {
            rrcb::Points given;
            self.attempt([&] {
                rrcb::c::require_cuts(own);
                given = points_in_parts(points, parts, fraction);
            });
            *fraction =
                rrcb::moved_fraction(given, view(parts, given.count), own.cuts.num_parts, self);
        });
}
