#include "c/balancer.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/duplicate.hpp"

#include <rrcb/locate.hpp>
#include <rrcb/transfer.hpp>

#include <algorithm>
#include <memory>
#include <span>

namespace rrcb::c {

namespace {

/// View of the arrays of a call. Where one is missing the view is of no use, which all ranks hear
/// of from the call that gets it.
Points points_of(int dimension, std::size_t count, const double* coordinates, const double* weights,
                 const Part* parts) {
    Points points;
    points.dimension = dimension;
    points.count = count;
    if (count == 0 || coordinates == nullptr || parts == nullptr) return points;
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
}

/// Parts of a call; a part that is none in place of an array that is missing, so that all ranks
/// hear of it.
std::span<const Part> parts_of(std::size_t count, const Part* parts) {
    static constexpr Part none = -1;
    if (count > 0 && parts == nullptr) return {&none, 1};
    return {parts, count};
}

/// The caller's room for a column.
std::byte* room_at(void* to, std::size_t num_bytes) {
    if (num_bytes > 0) require(to, "to");
    return static_cast<std::byte*>(to);
}

void create(MPI_Comm comm, rrcb_balancer** balancer) {
    Participant self{mpi::duplicate_of(comm)};
    std::unique_ptr<rrcb_balancer> made;
    self.attempt([&] {
        require(balancer, "balancer");
        made = std::make_unique<rrcb_balancer>();
        made->comm = comm;
    });
    agree(self);
    *balancer = made.release();
}

}  // namespace

}  // namespace rrcb::c

using rrcb::c::guarded;

int rrcb_create(MPI_Comm comm, rrcb_balancer** balancer) {
    return guarded([&] { rrcb::c::create(comm, balancer); });
}

int rrcb_create_fortran(MPI_Fint comm, rrcb_balancer** balancer) {
    return rrcb_create(MPI_Comm_f2c(comm), balancer);
}

int rrcb_balance(rrcb_balancer* balancer, int dimension, size_t count, const double* coordinates,
                 const double* weights, int32_t* parts) {
    return guarded(balancer, [&](auto& own) {
        const rrcb::Points points =
            rrcb::c::points_of(dimension, count, coordinates, weights, parts);
        rrcb::c::keep(rrcb::balance(points, own.options, own.comm), {parts, count}, own);
    });
}

int rrcb_rebalance(rrcb_balancer* balancer, int dimension, size_t count, const double* coordinates,
                   const double* weights, int32_t* parts) {
    return guarded(balancer, [&](auto& own) {
        const rrcb::Points points =
            rrcb::c::points_of(dimension, count, coordinates, weights, parts);
        rrcb::c::keep(rrcb::balance(points, own.options, own.comm, own.cuts), {parts, count}, own);
    });
}

int rrcb_gather_cuts(rrcb_balancer* balancer) {
    return guarded(balancer, [&](auto& own) { own.cuts = rrcb::whole_cuts(own.cuts, own.comm); });
}

int rrcb_assign(const rrcb_balancer* balancer, size_t count, const double* coordinates,
                int32_t* parts) {
    return guarded(balancer, [&](const auto& own) {
        if (own.cuts.dimension == 0)
            throw rrcb::Error(rrcb::ErrorCode::invalid_argument, "the balancer has no cuts yet");
        if (count > 0) rrcb::c::require(coordinates, "coordinates");
        if (count > 0) rrcb::c::require(parts, "parts");
        rrcb::assign(own.cuts,
                     rrcb::c::points_of(own.cuts.dimension, count, coordinates, nullptr, parts),
                     {parts, count});
    });
}

int rrcb_locate(const rrcb_balancer* balancer, size_t count, const double* coordinates,
                int32_t* parts) {
    return guarded(balancer, [&](const auto& own) {
        const rrcb::Points positions =
            rrcb::c::points_of(own.cuts.dimension, count, coordinates, nullptr, parts);
        std::ranges::copy(rrcb::locate(own.cuts, positions, own.comm), parts);
    });
}

int rrcb_make_plan(rrcb_balancer* balancer, size_t count, const int32_t* parts) {
    return guarded(balancer, [&](auto& own) {
        own.plan = rrcb::plan(rrcb::c::parts_of(count, parts), own.cuts.num_parts, own.comm);
    });
}

int rrcb_transfer(rrcb_balancer* balancer, size_t bytes, const void* from, void* to) {
    return guarded(balancer, [&](auto& own) {
        const std::size_t length = from == nullptr ? 0 : own.plan.num_points * bytes;
        const rrcb::detail::ByteColumn column{static_cast<const std::byte*>(from),
                                              length,
                                              rrcb::detail::ValueKind::other,
                                              1,
                                              bytes,
                                              to,
                                              rrcb::c::room_at};
        rrcb::detail::move(own.plan, {&column, 1}, {}, nullptr, own.comm);
    });
}
