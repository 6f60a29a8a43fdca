#include "bisection/bisection.hpp"

#include "bisection/axis_choice.hpp"
#include "bisection/patches.hpp"
#include "bisection/weighted_quantile.hpp"
#include "options/option_table.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <rrcb/method/bisection.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Task {
    const Options& options;
    AxisChoice axis_of;
    bool with_brackets;
    Bisection result;
};

/// Returns the cut that leaves the share `below` (0 ... 1) of the domain's weight below it.
Cut choose_cut(const StatisticalDomain& domain, double below, int depth, const Task& task) {
    const double weight = weight_of(domain);
    const Box box = extent_of(domain);
    const int axis = task.axis_of(task.result.cuts.tree.size(), depth, box);
    // First: a side of size 0 is empty even if the domain has no weight.
    if (below >= 1) return plane(axis, infinity);
    if (below <= 0 || !(weight > 0)) return plane(axis, -infinity);
    return weighted_quantile(Profile(domain, axis), below * weight, task.options.axes.plain);
}

void bisect_node(StatisticalDomain domain, const Descent& at, int depth, Task& task) {
    if (at.is_part()) {
        task.result.part_weights.push_back(weight_of(domain));
        return;
    }
    const auto sizes = std::span(task.options.part_sizes).subspan(at.first_part, at.num_parts);
    const double below = share_below(sizes, at.lower_parts());
    const Cut cut = choose_cut(domain, below, depth, task);
    task.result.cuts.tree.push_back(cut);
    if (task.with_brackets) task.result.brackets.push_back(bracket_of(domain, cut, below, depth));
    Halves halves = split_domain(domain, cut);
    domain.patches = {};
    bisect_node(std::move(halves.lower), at.lower(), depth + 1, task);
    bisect_node(std::move(halves.upper), at.upper(), depth + 1, task);
}

}  // namespace

double share_below(std::span<const double> sizes, int num_below) {
    const auto middle = sizes.begin() + num_below;
    const double below = std::accumulate(sizes.begin(), middle, 0.0);
    const double all = below + std::accumulate(middle, sizes.end(), 0.0);
    return all > 0 ? below / all : 0;
}

double expected_error(int depth) {
    return std::min(0.25, 0.01 * std::exp2(depth / 2.0));
}

Bisection bisect(StatisticalDomain domain, const Options& options, bool with_brackets) {
    Task task{options, {options, extent_of(domain), domain.dimension}, with_brackets, {}};
    task.result.cuts.dimension = domain.dimension;
    task.result.cuts.num_parts = options.num_parts;
    task.result.cuts.shape = options.tree;
    bisect_node(std::move(domain), root_of(task.result.cuts), 0, task);
    return std::move(task.result);
}

Bisection bisect(StatisticalDomain domain, int num_parts, std::span<const double> part_sizes) {
    require(num_parts >= 1, "num_parts must be at least 1");
    Options options;
    options.num_parts = num_parts;
    options.tree = TreeShape{};
    options.part_sizes.assign(part_sizes.begin(), part_sizes.end());
    if (part_sizes.empty()) options.part_sizes.assign(num_parts, 1.0);
    check_dimension(domain.dimension, "the domain");
    check_part_sizes(options, domain.dimension);
    return bisect(std::move(domain), options, false);
}

}  // namespace rrcb
