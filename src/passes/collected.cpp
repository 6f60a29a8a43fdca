#include "passes/collected.hpp"

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

Collected emptied(Collected memory, const Points& points) {
    memory.dimension = points.dimension;
    resize(0, points, memory);
    memory.weights.clear();
    memory.settled_weights = std::vector<double>();
    memory.settled_counts = std::vector<double>();
    return memory;
}

template <class Layout>
void append(const Layout& x, const Points& points, std::span<const LocalIndex> indices,
            Collected& collected) {
    const LocalIndex before = collected.count();
    resize(before + indices.size(), points, collected);
    for (std::size_t k = 0; k < indices.size(); ++k)
        copy(x, points, indices[k], before + k, collected);
}

/// Copies the points without a part.
void copy_open(const Points& points, std::span<const Part> parts, Collected& collected) {
    constexpr LocalIndex points_in_block = 512;
    std::array<LocalIndex, points_in_block> open;
    visit_layout(points, [&](const auto& x) {
        in_ranges(points.count, points_in_block, [&](LocalIndex first, LocalIndex last) {
            // Without branches, because the points come in any order.
            std::size_t num_open = 0;
            for (LocalIndex i = first; i < last; ++i) {
                open[num_open] = i;
                num_open += parts[i] < 0 ? 1 : 0;
            }
            append(x, points, std::span(open).first(num_open), collected);
        });
    });
}

}  // namespace

Collected collect(const Points& points, const Cuts& cuts, std::span<const Bracket> intervals,
                  bool has_parts, std::span<Part> parts, Collected memory) {
    Collected collected = emptied(std::move(memory), points);
    PartTotals totals = assign_settled(cuts, intervals, points, has_parts, parts);
    collected.settled_weights = std::move(totals.weights);
    collected.settled_counts = std::move(totals.counts);
    copy_open(points, parts, collected);
    return collected;
}

Collected collect_all(const Points& points, Collected memory) {
    Collected collected = emptied(std::move(memory), points);
    resize(points.count, points, collected);
    visit_layout(points, [&](const auto& x) {
        for (LocalIndex i = 0; i < points.count; ++i) copy(x, points, i, i, collected);
    });
    return collected;
}

std::vector<std::size_t> collect_more(const Points& points, std::span<const Wanted> wanted,
                                      std::span<Part> parts, Collected& collected) {
    const std::size_t num_parts = collected.settled_weights.size();
    std::vector<std::size_t> wanted_of(num_parts, wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k)
        std::fill_n(wanted_of.begin() + wanted[k].first_part, wanted[k].num_parts, k);
    RunningSums<double> weights(num_parts);
    LocalIndex num_added = 0;
    std::vector<LocalIndex> open;
    std::vector<std::size_t> found;
    visit_layout(points, [&](const auto& x) {
        for (LocalIndex i = 0; i < points.count; ++i) {
            const Part part = parts[i];
            if (part < 0 || wanted_of[part] == wanted.size()) continue;
            const Wanted& node = wanted[wanted_of[part]];
            if (node.contains(x(i, node.axis))) {
                open.push_back(i);
                found.push_back(wanted_of[part]);
                parts[i] = no_part;
                collected.settled_counts[part] -= 1;
            } else {
                weights[part] += points.weight(i);
                if (++num_added % weights.interval() == 0) weights.empty();
            }
        }
        append(x, points, open, collected);
    });
    weights.empty();
    for (std::size_t p = 0; p < num_parts; ++p)
        if (wanted_of[p] < wanted.size()) collected.settled_weights[p] = weights.totals()[p];
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
