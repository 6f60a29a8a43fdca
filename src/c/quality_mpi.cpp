#include "c/balancer.hpp"
#include "c/handle_mpi.hpp"
#include "lists/duplicated_mpi.hpp"

#include <algorithm>
#include <optional>

namespace {

using rrcb::CallName;
using rrcb::Part;
using rrcb::Participant;
using rrcb::Points;
using rrcb::c::guarded;
using rrcb::c::require;
using rrcb::c::view;

/// Writes a measure of the weights of parts.
template <class Measure>
int measured(Measure measure, size_t num_parts, const double* part_weights,
             const double* part_sizes, double* result) {
    return guarded([&] {
        rrcb::c::require_array(num_parts, part_weights,
                               "part_weights, or an array of one for each part,");
        require(result, "the result");
        measure(view(part_weights, num_parts), view(part_sizes, num_parts), result);
    });
}

/// Writes a measure of the parts of points over all ranks: `num_parts` results, or 1. Collective.
template <class Measure>
int measured_together(CallName call, Measure measure, const rrcb_balancer* balancer,
                      const rrcb_points* points, const int32_t* parts,
                      std::optional<size_t> num_parts, double* result) {
    return rrcb::c::guarded_together(call, balancer, [&](const auto& own, Participant& self) {
        Points measured;
        self.attempt([&] {
            rrcb::c::require_cuts(own);
            if (num_parts) rrcb::c::require_parts(own, *num_parts);
            measured = rrcb::c::points_of(points);
            rrcb::c::require_array(measured.count, parts, "parts");
            require(result, "the result");
        });
        measure(measured, view(parts, measured.count), own.cuts.num_parts, self, result);
    });
}

}  // namespace

int rrcb_imbalance(size_t num_parts, const double* part_weights, const double* part_sizes,
                   double* imbalance) {
    return measured(
        [](auto weights, auto sizes, double* to) { *to = rrcb::imbalance(weights, sizes); },
        num_parts, part_weights, part_sizes, imbalance);
}

int rrcb_load_unbalance_percent(size_t num_parts, const double* part_weights,
                                const double* part_sizes, double* percent) {
    return measured(
        [](auto weights, auto sizes, double* to) {
            std::ranges::copy(rrcb::load_unbalance_percent(weights, sizes), to);
        },
        num_parts, part_weights, part_sizes, percent);
}

int rrcb_worst_load_unbalance_percent(size_t num_parts, const double* part_weights,
                                      const double* part_sizes, double* percent) {
    return measured([](auto weights, auto sizes,
                       double* to) { *to = rrcb::worst_load_unbalance_percent(weights, sizes); },
                    num_parts, part_weights, part_sizes, percent);
}

int rrcb_part_weights(const rrcb_balancer* balancer, const rrcb_points* points,
                      const int32_t* parts, size_t num_parts, double* part_weights) {
    return measured_together(
        CallName::part_weights,
        [](const Points& of, auto each, int of_cuts, Participant& self, double* to) {
            std::ranges::copy(rrcb::part_weights(of, each, of_cuts, self), to);
        },
        balancer, points, parts, num_parts, part_weights);
}

int rrcb_moved_fraction(const rrcb_balancer* balancer, const rrcb_points* points,
                        const int32_t* parts, double* fraction) {
    return measured_together(
        CallName::moved_fraction,
        [](const Points& of, auto each, int num_parts, Participant& self, double* to) {
            *to = rrcb::moved_fraction(of, each, num_parts, self);
        },
        balancer, points, parts, std::nullopt, fraction);
}
