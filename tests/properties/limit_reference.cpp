#include "limit_reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace rrcb::test {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string fault_of_lines(const Cut& cut, const Options& options) {
    if (options.expert.axes.grid.empty() || std::isinf(cut.at[static_cast<std::size_t>(cut.axis)]))
        return {};
    const auto axis = static_cast<std::size_t>(cut.axis);
    const GridLines& lines = options.expert.axes.grid[axis];
    const double k = std::nearbyint(cut.at[axis] / lines.spacing - lines.origin / lines.spacing);
    bool on_line = false;
    for (const double near : {k - 1, k, k + 1})
        on_line |= cut.at[axis] == lines.origin + near * lines.spacing;
    if (!on_line) return "cut at " + std::to_string(cut.at[axis]) + " lies on no line";
    for (std::size_t a = 0; a < max_dimension; ++a)
        if (a != axis && cut.at[a] != -infinity) return "cut on a line breaks ties";
    return cut.divides == 0 ? "" : "cut on a line divides a place";
}

/// All bisections of a few points.
class Reference {
  public:
    Reference(const Points& points, const Options& options)
        : points_(points), options_(options), box_(bounding_box(points)) {
        for (int axis = 0; axis < points.dimension; ++axis) {
            const std::set<double> all = candidates(axis);
            candidates_[static_cast<std::size_t>(axis)] = {all.begin(), all.end()};
        }
    }

    double least() {
        std::vector<LocalIndex> all(points_.count);
        double weight = 0;
        for (LocalIndex i = 0; i < points_.count; ++i) weight += points_.weight(all[i] = i);
        const double heaviest = heaviest_part(all, Region{box_}, options_.num_parts, infinity);
        return weight > 0 ? heaviest * options_.num_parts / weight : heaviest;
    }

  private:
    /// A box, and the axes along which it ends where all points do, not at a cut.
    struct Region : Box {
        std::array<bool, max_dimension> is_outermost{true, true, true};
    };

    double min_width(int axis) const {
        return options_.expert.axes.min_width.empty()
                   ? 0
                   : options_.expert.axes.min_width[static_cast<std::size_t>(axis)];
    }

    /// Where moving a cut any farther would change something: behind a point, or a width away from
    /// another such place.
    std::set<double> candidates(int axis) const {
        const auto a = static_cast<std::size_t>(axis);
        std::set<double> all;
        if (!options_.expert.axes.grid.empty()) {
            const auto [origin, spacing] = options_.expert.axes.grid[a];
            const double first = std::floor((box_.lower[a] - origin) / spacing) - 1;
            for (double k = first; origin + k * spacing <= box_.upper[a]; ++k)
                all.insert(origin + k * spacing);
            return all;
        }
        std::set<double> starts{box_.lower[a], box_.upper[a]};
        for (LocalIndex i = 0; i < points_.count; ++i) {
            starts.insert(points_.coordinate(i, axis));
            starts.insert(std::nextafter(points_.coordinate(i, axis), infinity));
        }
        for (const double start : starts) {
            double up = start;
            double down = start;
            for (int k = 0; k < options_.num_parts; ++k) {
                all.insert(up);
                all.insert(down);
                up += min_width(axis);
                down -= min_width(axis);
            }
        }
        return all;
    }

    /// Two cells of a grid meet at a cut; a box keeps its width.
    bool is_wide(double lower, double upper, int axis, bool is_outermost) const {
        if (!options_.expert.axes.min_width.empty()) return upper - lower >= min_width(axis);
        return is_outermost ? upper >= lower : upper > lower;
    }

    /// Weight of the heaviest part at best, or at least `enough`.
    double heaviest_part(const std::vector<LocalIndex>& inside, const Region& region, int num_parts,
                         double enough) {
        if (num_parts == 1) {
            double weight = 0;
            for (const LocalIndex i : inside) weight += points_.weight(i);
            return weight;
        }
        for (int axis = 0; axis < points_.dimension; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            for (const double value : candidates_[a]) {
                if (!is_wide(region.lower[a], value, axis, false)) continue;
                if (!is_wide(value, region.upper[a], axis, region.is_outermost[a])) continue;
                enough =
                    std::min(enough, heaviest_with(inside, region, num_parts, axis, value, enough));
            }
        }
        return enough;
    }

    double heaviest_with(const std::vector<LocalIndex>& inside, const Region& region, int num_parts,
                         int axis, double value, double enough) {
        std::vector<LocalIndex> below;
        std::vector<LocalIndex> above;
        for (const LocalIndex i : inside)
            (points_.coordinate(i, axis) < value ? below : above).push_back(i);
        const auto a = static_cast<std::size_t>(axis);
        Region lower = region;
        Region upper = region;
        lower.upper[a] = value;
        lower.is_outermost[a] = false;
        upper.lower[a] = value;
        const int num_below = options_.expert.tree.lower_parts(num_parts);
        const double of_lower = heaviest_part(below, lower, num_below, enough);
        if (of_lower >= enough) return enough;
        return std::max(of_lower, heaviest_part(above, upper, num_parts - num_below, enough));
    }

    Points points_;
    const Options& options_;
    Box box_;
    std::array<std::vector<double>, max_dimension> candidates_;
};

}  // namespace

std::string fault_of_limits(const Cuts& cuts, const Options& options, const Box& box) {
    for (const Cut& cut : cuts.tree)
        if (const std::string fault = fault_of_lines(cut, options); !fault.empty()) return fault;
    for (Part part = 0; part < cuts.num_parts; ++part) {
        const auto p = static_cast<std::size_t>(part);
        if (!options.part_sizes.empty() && !(options.part_sizes[p] > 0)) continue;
        const Box region = box_of(cuts, part);
        for (std::size_t a = 0; a < static_cast<std::size_t>(cuts.dimension); ++a) {
            if (std::isinf(region.lower[a]) && std::isinf(region.upper[a])) continue;
            const double lower = std::isinf(region.lower[a]) ? box.lower[a] : region.lower[a];
            const double upper = std::isinf(region.upper[a]) ? box.upper[a] : region.upper[a];
            const bool is_cell = std::isinf(region.upper[a]) ? upper >= lower : upper > lower;
            const double width =
                options.expert.axes.min_width.empty() ? 0 : options.expert.axes.min_width[a];
            if (!is_cell || !(upper - lower >= width))
                return "part " + std::to_string(part) + " is " + std::to_string(upper - lower) +
                       " wide along axis " + std::to_string(a);
        }
    }
    return {};
}

double least_imbalance(const Points& points, const Options& options) {
    return Reference(points, options).least();
}

}  // namespace rrcb::test
