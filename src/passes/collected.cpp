#include "passes/collected.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/running_sums.hpp"
#include "passes/assignment.hpp"
#include "passes/point_layout.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace rrcb {

namespace {

/// Makes room for `count` entries.
void resize(LocalIndex count, const Points& points, Collected& collected) {
    collected.original.resize(count);
    collected.coordinates.resize(count * static_cast<LocalIndex>(points.dimension));
    if (!points.weights.empty()) collected.weights.resize(count);
}

/// Makes entry k a copy of point i.
template <class Layout>
void copy(const Layout& x, const Points& points, LocalIndex i, LocalIndex k, Collected& collected) {
    constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);
    collected.original[k] = i;
    for (std::size_t a = 0; a < dimension; ++a)
        collected.coordinates[k * dimension + a] = x(i, static_cast<int>(a));
    if (!points.weights.empty()) collected.weights[k] = points.weights[i];
}

void clear(const Points& points, Collected& collected) {
    collected.dimension = points.dimension;
    resize(0, points, collected);
    collected.weights.clear();
    collected.settled = {};
}

template <class Layout>
void append(const Layout& x, const Points& points, std::span<const LocalIndex> indices,
            Collected& collected) {
    const LocalIndex before = collected.count();
    resize(before + indices.size(), points, collected);
    for (std::size_t k = 0; k < indices.size(); ++k)
        copy(x, points, indices[k], before + k, collected);
}

/// Calls `visit(layout, indices)` with the points of each block for which `is_found(layout,
/// index)`.
template <class Test, class Visit>
void visit_in_blocks(const Points& points, const Test& is_found, Visit&& visit) {
    constexpr LocalIndex points_in_block = 512;
    std::array<LocalIndex, points_in_block> found;
    visit_layout(points, [&](const auto& x) {
        in_ranges(points.count, points_in_block, [&](LocalIndex first, LocalIndex last) {
            // Without branches, because the points come in any order.
            std::size_t num_found = 0;
            for (LocalIndex i = first; i < last; ++i) {
                found[num_found] = i;
                num_found += is_found(x, i) ? 1 : 0;
            }
            visit(x, std::span<const LocalIndex>(found).first(num_found));
        });
    });
}

}  // namespace

void collect(const Points& points, const Cuts& cuts, std::span<const Bracket> intervals,
             bool has_parts, std::span<Part> parts, Collected& collected) {
    clear(points, collected);
    collected.settled = assign_settled(cuts, intervals, points, has_parts, parts);
    const auto is_open = [&](const auto&, LocalIndex i) { return parts[i] < 0; };
    visit_in_blocks(points, is_open, [&](const auto& x, std::span<const LocalIndex> open) {
        append(x, points, open, collected);
    });
}

void collect_all(const Points& points, Collected& collected) {
    clear(points, collected);
    resize(points.count, points, collected);
    visit_layout(points, [&](const auto& x) {
        for (LocalIndex i = 0; i < points.count; ++i) copy(x, points, i, i, collected);
    });
}

namespace {

/// What the points of a part are collected for; none if the interval is empty.
struct WantedOfPart {
    double lower = infinity;
    double upper = -infinity;
    int axis = 0;
    std::size_t wanted = 0;
};

/// Returns an entry for each part, behind one for points without a part.
std::vector<WantedOfPart> wanted_of_parts(std::span<const Wanted> wanted, std::size_t num_parts) {
    std::vector<WantedOfPart> of_parts(num_parts + 1);
    for (std::size_t k = 0; k < wanted.size(); ++k)
        std::fill_n(
            of_parts.begin() + wanted[k].first_part + 1, wanted[k].num_parts,
            WantedOfPart{wanted[k].interval.lower, wanted[k].interval.upper, wanted[k].axis, k});
    return of_parts;
}

/// Weighs once more the points that are left in parts.
void weigh_again(const Points& points, std::span<const Part> parts,
                 std::span<const WantedOfPart> of_parts, std::vector<double>& part_weights) {
    RunningSums<double> weights(of_parts.size());
    in_ranges(points.count, weights.interval(), [&](LocalIndex first, LocalIndex last) {
        for (LocalIndex i = first; i < last; ++i) weights[parts[i] + 1] += points.weights[i];
        weights.empty();
    });
    for (std::size_t p = 0; p < part_weights.size(); ++p)
        if (of_parts[p + 1].lower < of_parts[p + 1].upper)
            part_weights[p] = weights.totals()[p + 1];
}

}  // namespace

std::vector<std::size_t> collect_more(const Points& points, std::span<const Wanted> wanted,
                                      std::span<Part> parts, Collected& collected) {
    const std::vector<WantedOfPart> of_parts =
        wanted_of_parts(wanted, collected.settled.weights.size());
    std::vector<std::size_t> found;
    const auto is_found = [&](const auto& x, LocalIndex i) {
        const WantedOfPart& node = of_parts[parts[i] + 1];
        const double value = x(i, node.axis);
        return value >= node.lower && value < node.upper;
    };
    visit_in_blocks(points, is_found, [&](const auto& x, std::span<const LocalIndex> open) {
        for (const LocalIndex i : open) {
            const Part part = std::exchange(parts[i], no_part);
            found.push_back(of_parts[part + 1].wanted);
            collected.settled.counts[part] -= 1;
        }
        append(x, points, open, collected);
    });
    if (points.weights.empty()) {
        collected.settled.weights = collected.settled.counts;
    } else {
        weigh_again(points, parts, of_parts, collected.settled.weights);
    }
    return found;
}

std::vector<Box> boxes_of_parts(const Points& points, std::span<const Part> parts, int num_parts) {
    std::vector<Box> boxes(static_cast<std::size_t>(num_parts));
    visit_layout(points, [&]<class Layout>(const Layout& x) {
        for (LocalIndex i = 0; i < points.count; ++i) {
            if (parts[i] < 0) continue;
            Box& box = boxes[parts[i]];
            for (std::size_t a = 0; a < static_cast<std::size_t>(Layout::dimension); ++a) {
                box.lower[a] = std::min(box.lower[a], x(i, static_cast<int>(a)));
                box.upper[a] = std::max(box.upper[a], x(i, static_cast<int>(a)));
            }
        }
    });
    return boxes;
}

}  // namespace rrcb
