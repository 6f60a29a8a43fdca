#include "options/request.hpp"

#include "options/axis_order.hpp"

#include <rrcb/detail/mix.hpp>
#include <rrcb/plan.hpp>

#include <algorithm>
#include <bit>
#include <limits>
#include <type_traits>
#include <vector>

namespace rrcb {

namespace {

std::uint64_t bits_of(double value) {
    return std::bit_cast<std::uint64_t>(value);
}

std::uint64_t bits_of(int value) {
    return static_cast<std::uint64_t>(value);
}

void add(double value, std::uint64_t& hash) {
    hash = detail::mix(hash ^ bits_of(value));
}

}  // namespace

std::uint64_t arithmetic_in_use() {
    // The numbers are volatile, so that they are computed at run time and not by the compiler.
    const volatile double one = 1;
    const volatile double tiny = std::numeric_limits<double>::epsilon() / 1024;
    const volatile double normal = std::numeric_limits<double>::min();
    const volatile double subnormal = std::numeric_limits<double>::denorm_min();
    const volatile double half = normal / 2;
    const bool found[] = {one + tiny > one, one - tiny < one, -one - tiny < -one, half == 0,
                          subnormal == 0};
    std::uint64_t bits = 0;
    for (const bool bit : found) bits = 2 * bits + (bit ? 1 : 0);
    return bits;
}

std::uint64_t hash_of(std::span<const double> values) {
    std::uint64_t hash = values.size();
    for (const double value : values) add(value, hash);
    return hash;
}

std::uint64_t hash_of(const Points& points) {
    std::uint64_t hash = points.count;
    if (points.count > 0)
        for (const LocalIndex i : {LocalIndex{0}, points.count / 2, points.count - 1})
            for (const double x : points.position(i)) add(x, hash);
    return std::max(hash, std::uint64_t{1});
}

std::uint64_t hash_if_leaving(const Points& points, std::span<const Part> parts, int num_parts,
                              int rank, int num_ranks) {
    Part latest = no_part;
    for (const Part part : parts) {
        if (part == latest) [[likely]]
            continue;
        if (!ranks_of_part(part, num_parts, num_ranks).contains(rank)) return hash_of(points);
        latest = part;
    }
    return 0;
}

std::uint64_t bits_of(const Option& option, const Options& options) {
    return visit_kind(option, [&]<class Kind>(const Kind& kind) {
        if constexpr (std::is_same_v<Kind, Choice>) {
            return bits_of(kind.get(options));
        } else if constexpr (std::is_same_v<Kind, Lists> || std::is_same_v<Kind, Rows>) {
            return hash_of(kind.get(options));
        } else {
            return bits_of(kind.field.get(options));
        }
    });
}

std::uint64_t bits_of(const Cuts& cuts) {
    std::uint64_t hash = (1 + max_dimension) * cuts.tree.size();
    add(cuts.shape.group_size, hash);
    add(cuts.shape.larger_below, hash);
    add(cuts.shape.round_robin_block, hash);
    add(cuts.debt, hash);
    for (const Part part : cuts.numbers) add(part, hash);
    for (const Cut& cut : cuts.tree) {
        add(cut.axis, hash);
        for (const double x : cut.at) add(x, hash);
    }
    return hash;
}

std::vector<double> values_of_part_sizes(const Options& options) {
    return options.part_sizes;
}

std::vector<double> values_of_tree(const Options& options) {
    const AxisOrder& order = options.expert.axes.order;
    std::vector<double> values{1.0 * is_grouped(order), 1.0 * is_given(order),
                               1.0 * is_among(order)};
    values.insert(values.end(), axes_in(order).begin(), axes_in(order).end());
    for (const auto& limits : {min_width_of(options), grid_of(options)}) {
        values.push_back(-1);
        values.insert(values.end(), limits.begin(), limits.end());
    }
    return values;
}

std::vector<double> min_width_of(const Options& options) {
    return options.expert.axes.min_width;
}

std::vector<double> grid_of(const Options& options) {
    std::vector<double> numbers;
    for (const GridLines& lines : options.expert.axes.grid)
        numbers.insert(numbers.end(), {lines.origin, lines.spacing});
    return numbers;
}

Request request_of(const Options& options, int dimension, const Cuts* previous) {
    Request request{};
    auto value = request.begin();
    *value++ = bits_of(dimension);
    for (const Option& option : option_table)
        if (is_compared(option)) *value++ = bits_of(option, options);
    *value++ = previous ? bits_of(*previous) : 0;
    *value = arithmetic_in_use();
    return request;
}

std::optional<std::size_t> first_difference(const Request& a, const Request& b) {
    const auto at = std::mismatch(a.begin(), a.end(), b.begin()).first;
    if (at == a.end()) return std::nullopt;
    return static_cast<std::size_t>(at - a.begin());
}

std::string_view name_of_request(std::size_t index) {
    if (index == 0) return "dimension";
    std::size_t at = 0;
    for (const Option& option : option_table)
        if (is_compared(option) && ++at == index) return option.name;
    return index == num_compared + 1 ? "previous" : name_of_arithmetic;
}

}  // namespace rrcb
