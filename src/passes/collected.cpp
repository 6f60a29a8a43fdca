#include "arithmetic/part_share.hpp"
#include "arithmetic/running_sums.hpp"
#include "passes/host_passes.hpp"
#include "passes/point_layout.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace rrcb {

namespace {

/// Reserves memory for `count` entries, which may be as many as the points of the rank.
void reserve(LocalIndex count, const Points& points, Collected& collected) {
    collected.original.reserve(count);
    collected.coordinates.reserve(count * static_cast<LocalIndex>(points.dimension));
    if (!points.weights.empty()) collected.weights.reserve(count);
}

/// Sets the number of entries to `count`.
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

/// Finds in each block the points for which is_found(layout, index) is true, and calls
/// visit(layout, indices) with them.
template <class Test, class Visit>
void visit_in_blocks(const Points& points, const Test& is_found, Visit&& visit) {
    constexpr LocalIndex points_in_block = 512;
    std::array<LocalIndex, points_in_block> found;
    visit_layout(points, [&](const auto& x) {
        in_ranges(points.count, points_in_block, [&](LocalIndex first, LocalIndex last) {
            // Has no branches, because they would be mispredicted for points in any order.
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

void HostPasses::collect(const Cuts& cuts, std::span<const Bracket> intervals, bool has_parts,
                         Collected& collected) {
    clear(points_, collected);
    collected.settled = assign_settled(cuts, intervals, points_, has_parts, parts_);
    reserve(points_.count - static_cast<LocalIndex>(sum_of(collected.settled.counts)), points_,
            collected);
    const auto is_open = [&](const auto&, LocalIndex i) { return parts_[i] < 0; };
    visit_in_blocks(points_, is_open, [&](const auto& x, std::span<const LocalIndex> open) {
        append(x, points_, open, collected);
    });
}

namespace {

/// Returns the index of the wanted node that contains each part, or the number of wanted nodes if
/// none does. The first entry is for points without a part.
std::vector<std::size_t> wanted_of_parts(std::span<const Wanted> wanted, std::size_t num_parts) {
    std::vector<std::size_t> of_parts(num_parts + 1, wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k)
        std::fill_n(of_parts.begin() + wanted[k].first_part + 1, wanted[k].num_parts, k);
    return of_parts;
}

/// Adds up the weights again of the points that remain in parts of wanted nodes.
void weigh_again(const Points& points, std::span<const Part> parts,
                 std::span<const std::size_t> of_parts, std::vector<double>& part_weights) {
    RunningSums<double> weights(of_parts.size());
    in_ranges(points.count, weights.interval(), [&](LocalIndex first, LocalIndex last) {
        for (LocalIndex i = first; i < last; ++i) weights[parts[i] + 1] += points.weights[i];
        weights.empty();
    });
    for (std::size_t p = 0; p < part_weights.size(); ++p)
        if (of_parts[p + 1] != of_parts[0]) part_weights[p] = weights.totals()[p + 1];
}

}  // namespace

std::vector<std::size_t> HostPasses::collect_more(std::span<const Wanted> wanted,
                                                  Collected& collected) {
    PartTotals& settled = collected.settled;
    const auto of_parts = wanted_of_parts(wanted, settled.weights.size());
    std::vector<Wanted> all(wanted.begin(), wanted.end());
    all.emplace_back();  // an empty node, for the other parts
    std::vector<std::size_t> found;
    const auto is_found = [&](const auto& x, LocalIndex i) {
        const Wanted& node = all[of_parts[parts_[i] + 1]];
        return node.contains(x(i, node.axis));
    };
    visit_in_blocks(points_, is_found, [&](const auto& x, std::span<const LocalIndex> open) {
        for (const LocalIndex i : open) {
            const Part part = std::exchange(parts_[i], no_part);
            found.push_back(of_parts[part + 1]);
            settled.counts[part] -= 1;
        }
        append(x, points_, open, collected);
    });
    if (points_.weights.empty()) {
        settled.weights = settled.counts;
    } else {
        weigh_again(points_, parts_, of_parts, settled.weights);
    }
    return found;
}

std::vector<Box> HostPasses::boxes(int num_parts) {
    std::vector<Box> boxes(static_cast<std::size_t>(num_parts));
    visit_layout(points_, [&]<class Layout>(const Layout& x) {
        for (LocalIndex i = 0; i < points_.count; ++i) {
            if (parts_[i] < 0) continue;
            Box& box = boxes[parts_[i]];
            for (std::size_t a = 0; a < static_cast<std::size_t>(Layout::dimension); ++a) {
                box.lower[a] = std::min(box.lower[a], x(i, static_cast<int>(a)));
                box.upper[a] = std::max(box.upper[a], x(i, static_cast<int>(a)));
            }
        }
    });
    return boxes;
}

}  // namespace rrcb
