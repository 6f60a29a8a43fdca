#include "balance_mpi.hpp"
#include "c/balancer.hpp"
#include "c/handle_mpi.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/duplicate.hpp"
#include "cuts/assign_mpi.hpp"
#include "cuts/gather_cuts_mpi.hpp"
#include "lists/plan_mpi.hpp"

#include <algorithm>
#include <memory>
#include <span>

namespace rrcb::c {

namespace {

/// View of the arrays of a call, of no use where require_arrays() throws.
Points points_of(int dimension, std::size_t count, const double* coordinates,
                 const double* weights) {
    Points points;
    points.dimension = dimension;
    points.count = count;
    if (count == 0 || coordinates == nullptr) return points;
    if (dimension < 1 || dimension > max_dimension) return points;
    const std::size_t length = count * static_cast<std::size_t>(dimension);
    const std::span<const double> each =
        weights == nullptr ? std::span<const double>() : std::span(weights, count);
    return interleaved_points(std::span(coordinates, length), dimension, each);
}

void keep(Balance&& balance, std::span<Part> parts, rrcb_balancer& own) noexcept {
    std::ranges::copy(balance.parts, parts.begin());
    own.cuts = std::move(balance.cuts);
    own.report = std::move(balance.report);
    own.parts = std::move(balance.parts);
}

/// The caller's room for a column.
std::byte* room_at(void* to, std::size_t num_bytes) {
    if (num_bytes > 0) require(to, "to");
    return static_cast<std::byte*>(to);
}

}  // namespace

}  // namespace rrcb::c

using rrcb::Participant;
using rrcb::c::guarded;
using rrcb::c::keep;
using rrcb::c::points_of;
using rrcb::c::require_arrays;
using rrcb::c::require_cuts;
using rrcb::c::require_plan;
using rrcb::mpi::duplicate_of;

int rrcb_create(MPI_Comm comm, rrcb_balancer** balancer) {
    return guarded([&] {
        auto made = rrcb::c::make_handle(comm, balancer, "balancer");
        made->comm = comm;
        *balancer = made.release();
    });
}

int rrcb_create_fortran(MPI_Fint comm, rrcb_balancer** balancer) {
    return rrcb_create(MPI_Comm_f2c(comm), balancer);
}

int rrcb_balance(rrcb_balancer* balancer, int dimension, size_t count, const double* coordinates,
                 const double* weights, int32_t* parts) {
    return guarded(balancer, [&](auto& own) {
        Participant self{duplicate_of(own.comm)};
        self.attempt([&] { require_arrays(count, coordinates, parts); });
        const rrcb::Points points = points_of(dimension, count, coordinates, weights);
        keep(rrcb::balance(points, own.options, nullptr, true, self, std::move(own.parts)),
             {parts, count}, own);
    });
}

int rrcb_rebalance(rrcb_balancer* balancer, int dimension, size_t count, const double* coordinates,
                   const double* weights, int32_t* parts) {
    return guarded(balancer, [&](auto& own) {
        Participant self{duplicate_of(own.comm)};
        self.attempt([&] {
            require_cuts(own);
            require_arrays(count, coordinates, parts);
        });
        const rrcb::Points points = points_of(dimension, count, coordinates, weights);
        keep(rrcb::balance(points, own.options, &own.cuts, true, self, std::move(own.parts)),
             {parts, count}, own);
    });
}

int rrcb_gather_cuts(rrcb_balancer* balancer) {
    return guarded(balancer, [&](auto& own) {
        Participant self{duplicate_of(own.comm)};
        self.attempt([&] { require_cuts(own); });
        own.cuts = rrcb::gather_cuts(own.cuts, self);
    });
}

int rrcb_assign(const rrcb_balancer* balancer, size_t count, const double* coordinates,
                int32_t* parts) {
    return guarded(balancer, [&](const auto& own) {
        require_cuts(own);
        require_arrays(count, coordinates, parts);
        rrcb::assign(own.cuts, points_of(own.cuts.dimension, count, coordinates, nullptr),
                     {parts, count});
    });
}

int rrcb_assign_all(const rrcb_balancer* balancer, size_t count, const double* coordinates,
                    int32_t* parts) {
    return guarded(balancer, [&](const auto& own) {
        Participant self{duplicate_of(own.comm)};
        self.attempt([&] {
            require_cuts(own);
            require_arrays(count, coordinates, parts);
        });
        const rrcb::Points positions = points_of(own.cuts.dimension, count, coordinates, nullptr);
        std::ranges::copy(rrcb::assign_all(own.cuts, positions, self), parts);
    });
}

int rrcb_make_plan(rrcb_balancer* balancer, size_t count, const int32_t* parts) {
    return guarded(balancer, [&](auto& own) {
        Participant self{duplicate_of(own.comm)};
        self.attempt([&] {
            require_cuts(own);
            if (count > 0) rrcb::c::require(parts, "parts");
        });
        const std::size_t length = parts == nullptr ? 0 : count;
        own.plan = rrcb::plan({parts, length}, own.cuts.num_parts, self);
    });
}

int rrcb_transfer(rrcb_balancer* balancer, size_t bytes, const void* from, void* to) {
    return guarded(balancer, [&](auto& own) {
        Participant self{duplicate_of(own.comm)};
        self.attempt([&] {
            require_plan(own);
            if (own.plan->num_points > 0 && bytes > 0) rrcb::c::require(from, "from");
        });
        const rrcb::Plan none;
        const rrcb::Plan& plan = own.plan ? *own.plan : none;
        const rrcb::detail::ByteColumn column{static_cast<const std::byte*>(from),
                                              plan.num_points * bytes,
                                              rrcb::detail::ValueKind::other,
                                              1,
                                              bytes,
                                              to,
                                              rrcb::c::room_at};
        rrcb::move(plan, {&column, 1}, {}, nullptr, self);
    });
}
