#include "expectations.hpp"

#include <sstream>

namespace rrcb::test {

namespace {

constexpr double rounding = 1e-12;

struct Tally {
    std::vector<double> part_weights;
    std::vector<double> counts;  ///< of points in the parts
    std::vector<double> sizes;
    TreeShape tree;
    double total = 0;
    double object = 0;
};

Tally tally(const Cloud& cloud, const std::vector<Part>& parts, const Options& options) {
    Tally result;
    const std::vector<double> weights = balanced_weights(cloud);
    result.part_weights.resize(static_cast<std::size_t>(options.num_parts));
    result.counts.resize(result.part_weights.size());
    for (LocalIndex i = 0; i < parts.size(); ++i) {
        result.part_weights[static_cast<std::size_t>(parts[i])] += weights[i];
        result.counts[static_cast<std::size_t>(parts[i])] += 1;
    }
    result.sizes = options.part_sizes;
    result.tree = options.expert.tree;
    if (result.sizes.empty()) result.sizes.assign(result.part_weights.size(), 1.0);
    result.total = std::accumulate(weights.begin(), weights.end(), 0.0);
    result.object = heaviest_object(cloud, options.expert.axes.plain);
    return result;
}

double sum(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Returns true if a side of a cut has so few points, for parts of equal size, that their number
/// may decide where it is.
bool fills_a_side(std::size_t first, std::size_t last, std::size_t num_below, const Tally& tally) {
    const std::span<const double> sizes = std::span(tally.sizes).subspan(first, last - first);
    const std::span<const double> counts = std::span(tally.counts).subspan(first, last - first);
    return std::ranges::min(sizes) == std::ranges::max(sizes) &&
           (sum(counts.first(num_below)) < 2.0 * static_cast<double>(num_below) ||
            sum(counts.subspan(num_below)) < 2.0 * static_cast<double>(counts.size() - num_below));
}

std::string fault_of_node(std::size_t first, std::size_t last, const Tally& tally) {
    if (last - first < 2) return {};
    const auto num_below =
        static_cast<std::size_t>(tally.tree.lower_parts(static_cast<int>(last - first)));
    const std::span<const double> weights(tally.part_weights);
    const std::span<const double> sizes(tally.sizes);
    const double all = sum(weights.subspan(first, last - first));
    const double all_sizes = sum(sizes.subspan(first, last - first));
    const double share = all_sizes > 0 ? sum(sizes.subspan(first, num_below)) / all_sizes : 0;
    const double below = sum(weights.subspan(first, num_below));
    const double allowed = share > 0 && share < 1 ? tally.object : 0;
    const bool is_wrong = std::abs(below - share * all) > allowed + rounding * tally.total;
    if (is_wrong && !fills_a_side(first, last, num_below, tally)) {
        std::ostringstream text;
        text << "parts " << first << " to " << last - 1 << " weigh " << all << ", " << below
             << " of it below the cut, not " << share * all << "; an object weighs at most "
             << allowed;
        return text.str();
    }
    const std::string fault = fault_of_node(first, first + num_below, tally);
    return fault.empty() ? fault_of_node(first + num_below, last, tally) : fault;
}

int num_levels(const TreeShape& tree, int num_parts) {
    if (num_parts < 2) return 0;
    const int below = tree.lower_parts(num_parts);
    return 1 + std::max(num_levels(tree, below), num_levels(tree, num_parts - below));
}

}  // namespace

bool is_exact(const Options& options) {
    return options.refine == Refine::exact;
}

bool is_to_tolerance(const Options& options) {
    return options.refine != Refine::none;
}

std::vector<double> balanced_weights(const Cloud& cloud) {
    const bool has_weight =
        std::ranges::any_of(cloud.weights, [](double weight) { return weight > 0; });
    return has_weight ? cloud.weights : std::vector<double>(cloud.size(), 1.0);
}

double heaviest_object(const Cloud& cloud, bool plain_cuts) {
    const std::vector<double> weights = balanced_weights(cloud);
    const Points points = cloud.points();
    std::map<std::pair<int, Vector>, double> objects;
    for (LocalIndex i = 0; i < cloud.size(); ++i) {
        if (!plain_cuts) objects[{0, points.position(i)}] += weights[i];
        for (int axis = 0; plain_cuts && axis < cloud.dimension; ++axis)
            objects[{axis, {points.coordinate(i, axis)}}] += weights[i];
    }
    double heaviest = 0;
    for (const auto& [place, weight] : objects) heaviest = std::max(heaviest, weight);
    return heaviest;
}

std::string fault_of_exact_cuts(const Cloud& cloud, const std::vector<Part>& parts,
                                const Options& options) {
    const Tally result = tally(cloud, parts, options);
    return fault_of_node(0, result.sizes.size(), result);
}

std::string fault_of_heaviest_part(const Cloud& cloud, const std::vector<Part>& parts,
                                   const Options& options, double tolerance) {
    const Tally result = tally(cloud, parts, options);
    const double all_sizes = sum(result.sizes);
    for (std::size_t p = 0; p < result.sizes.size(); ++p) {
        const double most = tolerance * result.total * (result.sizes[p] / all_sizes) +
                            num_levels(options.expert.tree, options.num_parts) * result.object +
                            rounding * result.total;
        if (result.part_weights[p] <= most) continue;
        std::ostringstream text;
        text << "part " << p << " weighs " << result.part_weights[p] << ", more than " << most;
        return text.str();
    }
    return {};
}

std::string fault_of_range(const std::vector<Part>& parts, int num_parts) {
    for (const Part part : parts)
        if (part < 0 || part >= num_parts) return "part " + std::to_string(part);
    return {};
}

std::string fault_of_look_ups(const Cloud& cloud, const std::vector<Part>& parts,
                              const Cuts& cuts) {
    const Points points = cloud.points();
    for (LocalIndex i = 0; i < cloud.size(); ++i) {
        const Vector x = points.position(i);
        const std::string who = "point " + std::to_string(i);
        if (part_of(cuts, x) != parts[i]) return who + " is looked up in another part";
        const std::vector<Part> touching = parts_touching(cuts, {x, x});
        if (touching != std::vector<Part>{parts[i]}) return who + "'s box touches other parts";
        const Box region = box_of(cuts, parts[i]);
        for (std::size_t a = 0; a < static_cast<std::size_t>(cloud.dimension); ++a)
            if (x[a] < region.lower[a] || x[a] > region.upper[a])
                return who + " lies outside the region of its part";
    }
    return {};
}

}  // namespace rrcb::test
