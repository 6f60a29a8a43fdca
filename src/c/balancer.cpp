#include "c/balancer.hpp"

#include "c/sized.hpp"
#include "options/option_table.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <rrcb/restart.hpp>
#include <rrcb/version.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

namespace rrcb::c {

namespace {

thread_local Failure last_failure;
thread_local Origin last_origin;

void set_option(const char* name, const char* value, Options& options) {
    require(name, "option");
    require(value, "value");
    const Option* option = find_option(name);
    if (option == nullptr)
        reject("there is no option \"" + std::string(name) + "\"; docs/parameters.md lists them" +
               suggestion(name, option_names()));
    if (std::holds_alternative<Lists>(option->kind))
        reject(std::string(name) + " cannot be set by a text; call rrcb_balancer_set_part_sizes");
    if (!read_option(*option, value, options))
        reject(std::string(name) + " takes " + texts_of(*option) + ", not \"" + value + '"');
}

// Both structs consist of an axis, a flag and three numbers.
static_assert(sizeof(rrcb_cut) == sizeof(Cut) && offsetof(rrcb_cut, at) == offsetof(Cut, at));

Cuts copy_of(const rrcb_cuts& given) {
    const auto size = static_cast<std::size_t>(std::max(given.num_parts, 1) - 1);
    if (size > 0) require(given.tree, "tree");
    if (given.larger_below != 0 && given.larger_below != 1)
        reject("larger_below must be 0 or 1, not " + std::to_string(given.larger_below));
    Cuts cuts{given.dimension, given.num_parts, std::vector<Cut>(size)};
    cuts.shape = {given.group_size, given.larger_below != 0, given.round_robin_block};
    std::ranges::transform(std::span(given.tree, size), cuts.tree.begin(), [](const rrcb_cut& cut) {
        return Cut{cut.axis, cut.divides, std::to_array(cut.at)};
    });
    if (given.numbers) cuts.numbers.assign(given.numbers, given.numbers + size + 1);
    cuts.debt = given.debt;
    check_tree(cuts);
    return cuts;
}

}  // namespace

int code_of(const Failure& failure, const Origin& origin) noexcept {
    if (!failure.failed) return RRCB_OK;
    last_failure = failure;
    last_origin = origin;
    constexpr std::array codes = {RRCB_INVALID_ARGUMENT, RRCB_OUT_OF_MEMORY, RRCB_MPI_ERROR,
                                  RRCB_INTERNAL_ERROR};
    static_assert(codes.size() == static_cast<int>(ErrorCode::internal) + 1);
    return codes[static_cast<std::size_t>(failure.code)];
}

Origin origin_of_last_failure() noexcept {
    return last_origin;
}

void require(const void* pointer, const char* name) {
    if (pointer == nullptr) reject(std::string(name) + " is null");
}

void require_handle(const void* handle, const char* name) {
    if (handle == nullptr)
        reject(std::string(name) + " is null: it was not created, or is destroyed");
}

void require_array(std::size_t count, const void* values, const char* name) {
    if (count > 0 && values == nullptr)
        reject(std::string(name) + " is null (in Fortran: or has the wrong length); it must hold " +
               std::to_string(count) + (count == 1 ? " entry" : " entries"));
}

void require_cuts(const rrcb_balancer& own) {
    if (own.cuts.empty())
        reject("the balancer has no cuts yet; call rrcb_balance or rrcb_set_cuts");
}

void require_parts(const rrcb_balancer& own, std::size_t num_parts) {
    require_cuts(own);
    if (num_parts != static_cast<std::size_t>(own.cuts.num_parts))
        reject("the cuts have " + std::to_string(own.cuts.num_parts) + " parts, not " +
               std::to_string(num_parts) + "; give an array with an entry for each");
}

void require_plan(const rrcb_balancer& own) {
    if (!own.plan) reject("the balancer has no plan yet; call rrcb_plan");
}

}  // namespace rrcb::c

using rrcb::c::guarded;
using rrcb::c::require;
using rrcb::c::require_cuts;
using rrcb::c::require_plan;

const char* rrcb_version(void) {
    return rrcb::version();
}

const char* rrcb_build_info(void) {
    return rrcb::build_info();
}

const char* rrcb_last_error(void) {
    return rrcb::c::last_failure.text.data();
}

void rrcb_balancer_destroy(rrcb_balancer** balancer) {
    rrcb::c::destroy(balancer);
}

int rrcb_balancer_set(rrcb_balancer* balancer, const char* option, const char* value) {
    return guarded(balancer, [&](auto& own) { rrcb::c::set_option(option, value, own.options); });
}

int rrcb_balancer_set_part_sizes(rrcb_balancer* balancer, size_t count, const double* sizes) {
    return guarded(balancer, [&](auto& own) {
        if (count > 0) require(sizes, "sizes");
        own.options.part_sizes.assign(sizes, sizes + count);
    });
}

int rrcb_get_report(const rrcb_balancer* balancer, rrcb_report* report) {
    return guarded(balancer, [&](const auto& own) {
        rrcb::c::require_sized(report, "report");
        if (!own.report) rrcb::reject("the balancer has no report yet; call rrcb_balance");
        const rrcb::Report& from = *own.report;
        const rrcb::ReportDetails& details = from.details;
        rrcb::c::copy_out(
            {0, from.imbalance, from.within_tolerance ? 1 : 0, from.kept ? 1 : 0,
             details.num_points, details.total_weight, details.least_imbalance,
             details.estimated_imbalance, details.num_cells, details.rounds,
             details.coincident_cuts, details.all_weights_zero ? 1 : 0, details.num_empty_parts},
            report);
    });
}

int rrcb_get_cuts(const rrcb_balancer* balancer, rrcb_cuts* cuts) {
    return guarded(balancer, [&](const auto& own) {
        rrcb::c::require_sized(cuts, "cuts");
        require_cuts(own);
        rrcb::c::copy_out(
            {0, own.cuts.dimension, own.cuts.num_parts,
             reinterpret_cast<const rrcb_cut*>(own.cuts.tree.data()), own.cuts.shape.group_size,
             own.cuts.shape.larger_below ? 1 : 0, own.cuts.shape.round_robin_block,
             own.cuts.numbers.empty() ? nullptr : own.cuts.numbers.data(), own.cuts.debt},
            cuts);
    });
}

int rrcb_set_cuts(rrcb_balancer* balancer, const rrcb_cuts* cuts) {
    return guarded(balancer, [&](auto& own) {
        own.cuts =
            cuts == nullptr ? rrcb::Cuts{} : rrcb::c::copy_of(rrcb::c::copy_in(cuts, "cuts"));
        own.least_count = rrcb_balancer::no_count;
    });
}

int rrcb_save_cuts(rrcb_balancer* balancer, const void** bytes, size_t* size) {
    return guarded(balancer, [&](auto& own) {
        require(bytes, "bytes");
        require(size, "size");
        require_cuts(own);
        own.saved = rrcb::save(own.cuts);
        rrcb::c::show(own.saved, bytes, size);
    });
}

int rrcb_load_cuts(rrcb_balancer* balancer, const void* bytes, size_t size) {
    return guarded(balancer, [&](auto& own) {
        own.cuts = rrcb::load<rrcb::Cuts>(rrcb::c::saved_bytes(bytes, size));
        own.least_count = rrcb_balancer::no_count;
    });
}

int rrcb_part_of(const rrcb_balancer* balancer, const double* position, int32_t* part) {
    return guarded(balancer, [&](const auto& own) {
        require(position, "position");
        require(part, "part");
        require_cuts(own);
        rrcb::Vector at{};
        std::copy_n(position, own.cuts.dimension, at.begin());
        *part = rrcb::part_of(own.cuts, at);
        own.lower_count(0);
    });
}

int rrcb_assign(const rrcb_balancer* balancer, const rrcb_points* points, int32_t* parts) {
    return guarded(balancer, [&](const auto& own) {
        require_cuts(own);
        const rrcb::Points positions = rrcb::c::points_of(points);
        rrcb::c::require_array(positions.count, parts, "parts");
        rrcb::assign(own.cuts, positions, {parts, positions.count});
        own.lower_count(positions.count);
    });
}

int rrcb_box_of(const rrcb_balancer* balancer, int32_t part, double* lower, double* upper) {
    return guarded(balancer, [&](const auto& own) {
        require(lower, "lower");
        require(upper, "upper");
        require_cuts(own);
        const rrcb::Box box = rrcb::box_of(own.cuts, part);
        std::ranges::copy(box.lower, lower);
        std::ranges::copy(box.upper, upper);
    });
}

int rrcb_parts_touching(const rrcb_balancer* balancer, const double* lower, const double* upper,
                        size_t capacity, int32_t* parts, size_t* count) {
    return guarded(balancer, [&](const auto& own) {
        require(lower, "lower");
        require(upper, "upper");
        require(count, "count");
        rrcb::c::require_array(capacity, parts, "parts");
        require_cuts(own);
        rrcb::Box box{{}, {}};
        std::copy_n(lower, own.cuts.dimension, box.lower.begin());
        std::copy_n(upper, own.cuts.dimension, box.upper.begin());
        const std::vector<rrcb::Part> touching = rrcb::parts_touching(own.cuts, box);
        *count = touching.size();
        std::copy_n(touching.begin(), std::min(capacity, touching.size()), parts);
    });
}

int rrcb_release_buffers(rrcb_balancer* balancer) {
    return guarded(balancer, [](const auto& own) { rrcb::release_buffers(own.comm); });
}

int rrcb_get_plan(const rrcb_balancer* balancer, rrcb_plan_lists* plan) {
    return guarded(balancer, [&](const auto& own) {
        rrcb::c::require_sized(plan, "plan");
        require_plan(own);
        const rrcb::Plan& from = *own.plan;
        rrcb::c::copy_out(
            {0, from.num_points, rrcb::c::num_points_after(from), from.export_indices.size(),
             from.export_indices.data(), from.export_ranks.data(), from.export_parts.data(),
             from.import_indices.size(), from.import_ranks.data(), from.import_indices.data(),
             from.import_parts.data()},
            plan);
    });
}
