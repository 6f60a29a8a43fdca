#include "options/validation.hpp"

#include "options/axis_order.hpp"
#include "options/option_table.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <utility>

namespace rrcb {

namespace {

bool is_grid(const GridLines& lines) {
    return std::isfinite(lines.origin) && std::isfinite(lines.spacing) && lines.spacing > 0;
}

std::string tally(std::size_t bad) {
    return " (" + std::to_string(bad) + (bad == 1 ? " such value" : " such values") +
           " on this rank)";
}

/// Returns true if the number of cuts in the tree fits the number of parts and the shape.
bool has_its_cuts(const Cuts& cuts) {
    return cuts.num_parts >= 1 && cuts.shape.group_size >= 1 &&
           cuts.shape.number_fits(cuts.num_parts) && std::ssize(cuts.tree) + 1 == cuts.num_parts;
}

/// Returns true if each part is at exactly one end of the tree.
bool has_legal_numbers(const Cuts& cuts) {
    if (cuts.numbers.empty()) return std::isfinite(cuts.debt);
    std::vector<bool> is_there(static_cast<std::size_t>(cuts.num_parts));
    for (const Part part : cuts.numbers)
        if (part >= 0 && part < cuts.num_parts) is_there[part] = true;
    return cuts.numbers.size() == is_there.size() && std::ranges::count(is_there, false) == 0 &&
           std::isfinite(cuts.debt);
}

bool has_legal_cuts(const Cuts& cuts) {
    return std::ranges::all_of(cuts.tree, [&](const Cut& cut) {
        return cut.axis >= 0 && cut.axis < cuts.dimension &&
               (cut.divides == 0 || cut.divides == 1) &&
               std::ranges::none_of(cut.at, [](double x) { return std::isnan(x); });
    });
}

/// Returns true if all axes are different and in the range from 0 to `end` - 1.
bool are_distinct(std::span<const int> axes, int end) {
    std::array<bool, max_dimension> named{};
    return std::ranges::all_of(axes, [&](int axis) {
        return axis >= 0 && axis < end && !std::exchange(named[axis], true);
    });
}

void check_grouped(std::span<const int> axes, int dimension) {
    const auto is_of_points = [&](int axis) { return axis < dimension; };
    if (!are_distinct(axes, max_dimension) ||
        std::ranges::count_if(axes, is_of_points) != dimension)
        reject("axes.order must name every axis of the points once if it groups them, " +
               std::string(dimension == 1   ? "0"
                           : dimension == 2 ? "0 and 1"
                                            : "0, 1 and 2"));
}

void check_among(std::span<const int> axes, int dimension) {
    require(!axes.empty(), "axes.order must name an axis if cuts may cross some axes only");
    require(are_distinct(axes, dimension),
            "axes.order must name axes of the points, each once, if cuts may cross some axes only");
}

void check_given(std::span<const int> axes, int num_parts, int dimension) {
    require(axes.size() + 1 == static_cast<std::size_t>(num_parts),
            "axes.order must hold one axis per cut if they are given, one less than there are "
            "parts");
    for (const int axis : axes)
        require(axis >= 0 && axis < dimension, "axes.order must hold axes of the points");
}

/// Returns a shape whose groups are the parts of each machine. Returns no groups if halving makes
/// the same tree, or if the ranks cannot have equal numbers of parts.
TreeShape shape_by_machines(int num_parts, const Ranks& ranks) {
    const bool is_full = ranks.number % ranks.per_machine == 0;
    const auto machines = static_cast<unsigned>((ranks.number - 1) / ranks.per_machine + 1);
    if (num_parts % ranks.number != 0 || ranks.per_machine == 1) return {};
    const int parts_of_rank = num_parts / ranks.number;
    if (!ranks.dealt && is_full && std::has_single_bit(machines)) return {};
    return {parts_of_rank * ranks.per_machine, false, ranks.dealt ? parts_of_rank : 0};
}

}  // namespace

Options complete(Options options, const Ranks& ranks, const Cuts* previous) {
    if (options.num_parts == 0) options.num_parts = ranks.number;
    if (options.expert.tree.group_size == 0) {
        require(options.expert.tree.round_robin_block == 0,
                "tree.round_robin_block needs tree.group_size; set both, or neither");
        const TreeShape shape =
            previous ? previous->shape : shape_by_machines(options.num_parts, ranks);
        // If many ranks make the parts, the parts of each rank must be consecutive.
        const bool is_central =
            std::min(options.num_parts, ranks.number) <= options.expert.max_root_parts;
        const bool fits =
            shape.round_robin_block == 0 || (is_central && shape.number_fits(options.num_parts));
        options.expert.tree.group_size = fits ? std::max(shape.group_size, 1) : 1;
        options.expert.tree.round_robin_block = fits ? shape.round_robin_block : 0;
        require(
            previous || options.expert.tree.group_size == 1 || !is_given(options.expert.axes.order),
            "axes.order gives the axis of each cut; set tree to the shape of the tree that "
            "they are for, as the machines ask for another one");
    }
    if (!options.expert.axes.grid.empty()) options.expert.axes.plain = true;
    return options;
}

void check_part_sizes(const Options& options, int) {
    const std::vector<double>& sizes = options.part_sizes;
    if (sizes.empty()) return;
    require(sizes.size() == static_cast<std::size_t>(options.num_parts),
            "part_sizes must hold one entry per part, or none for equal parts");
    double sum = 0;
    for (const double size : sizes) {
        require(std::isfinite(size) && size >= 0, "part_sizes must be finite and not negative");
        sum += size;
    }
    require(sum > 0 && std::isfinite(sum), "part_sizes must have a positive, finite sum");
}

void check_tree_options(const Options& options, int dimension) {
    require(options.expert.tree.number_fits(options.num_parts),
            "tree.round_robin_block must divide tree.group_size and num_parts; the last group must "
            "be full, or "
            "lack so many parts");
    const AxisOrder& order = options.expert.axes.order;
    if (is_among(order)) check_among(axes_in(order), dimension);
    if (is_grouped(order)) check_grouped(axes_in(order), dimension);
    if (is_given(order)) check_given(axes_in(order), options.num_parts, dimension);
}

void check_tree(const Cuts& cuts) {
    check_dimension(cuts.dimension, "cuts");
    require(has_its_cuts(cuts),
            "the tree must hold one cut less than there are parts, in groups of 1 or more");
    require(has_legal_cuts(cuts), illegal_cut);
    require(has_legal_numbers(cuts), illegal_numbers);
}

void check_positions(const Points& positions, const Cuts& cuts) {
    check_tree(cuts);
    require(positions.dimension == cuts.dimension, "positions must have the dimension of the cuts");
    check_layout(positions);
}

bool set_min_width(Options& options, const std::vector<double>& numbers) {
    const auto is_legal = [](double width) { return width > 0 && std::isfinite(width); };
    if (numbers.size() > max_dimension || !std::ranges::all_of(numbers, is_legal)) return false;
    options.expert.axes.min_width = numbers;
    return true;
}

bool set_grid(Options& options, const std::vector<double>& numbers) {
    std::vector<GridLines> grid;
    for (std::size_t k = 0; k + 1 < numbers.size(); k += 2)
        grid.push_back({numbers[k], numbers[k + 1]});
    const bool is_complete = numbers.size() % 2 == 0 && grid.size() <= max_dimension;
    if (!is_complete || !std::ranges::all_of(grid, is_grid)) return false;
    options.expert.axes.grid = std::move(grid);
    return true;
}

void check_min_width(const Options& options, int dimension) {
    const std::vector<double>& min_width = options.expert.axes.min_width;
    require(min_width.empty() || std::ssize(min_width) == dimension,
            "axes.min_width must hold one number per axis of the points, or be empty");
    Options unused;
    require(set_min_width(unused, min_width), "axes.min_width must be finite and above 0");
}

void check_grid(const Options& options, int dimension) {
    const std::vector<GridLines>& grid = options.expert.axes.grid;
    require(grid.empty() || std::ssize(grid) == dimension,
            "axes.grid must hold the lines across each axis of the points, or be empty");
    require(std::ranges::all_of(grid, is_grid),
            "axes.grid must have finite origins, and spacings that are finite and above 0");
}

void check_previous(const Cuts& previous, const Options& options, int dimension) {
    if (previous.num_parts != options.num_parts)
        reject(
            "previous cuts have " + std::to_string(previous.num_parts) + " parts, not " +
            std::to_string(options.num_parts) +
            "; pass no cuts ({}; None; in C rrcb_set_cuts(balancer, NULL)), or set num_parts to " +
            std::to_string(previous.num_parts) + " to keep their parts");
    require(previous.dimension == dimension && previous.shape == options.expert.tree &&
                has_its_cuts(previous),
            "previous cuts must have the dimension and the shape of tree asked for; "
            "pass no cuts ({}; None; in C rrcb_set_cuts(balancer, NULL))");
    require(has_legal_cuts(previous), illegal_cut);
    require(has_legal_numbers(previous), illegal_numbers);
}

void check_options(const Options& options, int dimension) {
    for (const Option& option : option_table) {
        if (!is_legal(option, options, dimension))
            reject(std::string(option.name) + " must be " + requirement(option, dimension));
        visit_kind(option, [&](const auto& kind) {
            if constexpr (requires { kind.check; }) kind.check(options, dimension);
        });
    }
}

void reject_coordinates(const Points& points) {
    std::size_t bad = 0;
    std::string first;
    for (LocalIndex i = 0; i < points.count; ++i)
        for (int axis = 0; axis < points.dimension; ++axis)
            if (!std::isfinite(points.coordinate(i, axis)) && bad++ == 0)
                first = std::to_string(i) + " on axis " + std::to_string(axis);
    reject("coordinate of point " + first + " is NaN or infinite" + tally(bad));
}

std::size_t scalar_bytes(const Points& points) {
    return points.type == ScalarType::float32 ? sizeof(float) : sizeof(double);
}

bool is_interleaved(const Points& points) {
    const std::size_t bytes = scalar_bytes(points);
    const auto dimension = static_cast<std::size_t>(points.dimension);
    if (points.stride != dimension * bytes) return false;
    for (std::size_t a = 1; a < dimension; ++a)
        if (points.axes[a] != static_cast<const std::byte*>(points.axes[0]) + a * bytes)
            return false;
    return true;
}

void check_layout(const Points& points) {
    check_dimension(points.dimension, "points");
    require(points.type == ScalarType::float64 || points.type == ScalarType::float32,
            "the type of the points must be ScalarType::float64 or float32");
    require(points.stride != detail::left_over,
            "the length of the coordinate array must be a multiple of the dimension");
    require(points.stride != detail::unequal,
            "coordinate arrays must all have the same length and a positive stride");
    const std::size_t bytes = scalar_bytes(points);
    require(points.stride % bytes == 0 && (points.stride > 0 || points.count < 2),
            "the stride of the points must be in bytes, a multiple of the size of a coordinate, "
            "and not 0");
    require(points.count <= PTRDIFF_MAX / std::max(points.stride, bytes),
            "count and stride exceed the memory; count is the number of points of this rank");
    for (int a = 0; a < points.dimension; ++a)
        require(points.count == 0 || points.axes[static_cast<std::size_t>(a)] != nullptr,
                "coordinates must be there on each axis; an entry of axes is null");
}

void check_dimension(int dimension, const char* name) {
    if (dimension < 1 || dimension > max_dimension)
        reject(std::string(name) +
               " must have 1, 2 or 3 dimensions, also on a rank without points");
}

void require_parts(int num_parts) {
    require(num_parts >= 1, "num_parts must be at least 1");
}

void check_parts(std::span<const Part> parts, int num_parts) {
    require_parts(num_parts);
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i] < 0 || parts[i] >= num_parts)
            reject("part " + std::to_string(parts[i]) + " of point " + std::to_string(i) +
                   " is none of the " + std::to_string(num_parts) + " parts; they count from 0");
}

void check_ranks(std::span<const RankRange> ranks_of_parts, int num_ranks) {
    for (const RankRange& ranks : ranks_of_parts)
        require(ranks.first_rank >= 0 && ranks.count >= 1 &&
                    ranks.count <= num_ranks - ranks.first_rank,
                "ranks_of_parts must name ranks of this communicator");
}

void reject_weights(const Points& points) {
    const auto is_bad = [](double weight) { return !(weight >= 0 && std::isfinite(weight)); };
    const auto first = std::ranges::find_if(points.weights, is_bad);
    if (first == points.weights.end()) reject("the sum of the weights overflows; scale them down");
    reject("weight of point " + std::to_string(first - points.weights.begin()) +
           " is negative, NaN or infinite" + tally(std::ranges::count_if(points.weights, is_bad)) +
           "; give 0 or more");
}

void check_lengths(const Points& points) {
    check_layout(points);
    require(points.weights.empty() || points.weights.size() == points.count,
            "weights must hold one entry per point, or none for unit weights");
}

void check_arrays(const Points& points) {
    check_lengths(points);
    bool are_positive = true;
    double sum = 0;
    for (const double weight : points.weights) {
        are_positive = are_positive && weight >= 0;
        sum += weight;
    }
    if (!are_positive || !std::isfinite(sum)) reject_weights(points);
}

Box check_points(const Points& points) {
    check_arrays(points);
    const Box box = bounding_box(points);
    for (int a = 0; a < points.dimension; ++a)
        if (std::isnan(box.lower[a])) reject_coordinates(points);
    return box;
}

void normalize(std::vector<double>& sizes, int num_parts) {
    if (sizes.empty()) sizes.assign(num_parts, 1.0);
    const int exponent = std::ilogb(std::accumulate(sizes.begin(), sizes.end(), 0.0));
    for (double& size : sizes) size = std::ldexp(size, -exponent);
}

}  // namespace rrcb
