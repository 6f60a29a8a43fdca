#include "fragments.hpp"

#include "sides.hpp"

#include <algorithm>

namespace rrcb {

namespace {

void swap_entries(SortedPoints& points, LocalIndex i, LocalIndex j) {
    const auto d = static_cast<std::size_t>(points.dimension());
    std::swap_ranges(&points.coordinates[i * d], &points.coordinates[i * d] + d,
                     &points.coordinates[j * d]);
    std::swap(points.original[i], points.original[j]);
    if (!points.weights.empty()) std::swap(points.weights[i], points.weights[j]);
}

double weight_of(const SortedPoints& points, LocalIndex first, LocalIndex last) {
    if (points.weights.empty()) return static_cast<double>(last - first);
    double weight = 0;
    for (LocalIndex i = first; i < last; ++i) weight += points.weights[i];
    return weight;
}

/// Brings the entries below the cut to the front; returns where those above begin.
LocalIndex partition(const Fragment& fragment, const Cut& cut, SortedPoints& points) {
    LocalIndex front = fragment.first;
    LocalIndex back = fragment.last;
    while (front < back) {
        if (!is_above(cut, points.position(front), points.dimension())) {
            ++front;
        } else {
            swap_entries(points, front, --back);
        }
    }
    return front;
}

}  // namespace

std::vector<Fragment> cell_fragments(const SortedPoints& points) {
    std::vector<Fragment> fragments;
    for (LocalIndex cell = 0; cell + 1 < points.first.size(); ++cell) {
        const LocalIndex first = points.first[cell];
        const LocalIndex last = points.first[cell + 1];
        if (first == last) continue;
        fragments.push_back(
            {first, last, weight_of(points, first, last), enclosing_box(points.mesh, cell)});
    }
    return fragments;
}

std::pair<std::vector<Fragment>, std::vector<Fragment>> split(
    const std::vector<Fragment>& fragments, const Cut& cut, SortedPoints& points) {
    std::vector<Fragment> lower;
    std::vector<Fragment> upper;
    const auto axis = static_cast<std::size_t>(cut.axis);
    for (const Fragment& fragment : fragments) {
        const Sides sides = sides_of(fragment.box, cut, points.dimension());
        const LocalIndex middle = sides.below && sides.above ? partition(fragment, cut, points)
                                  : sides.below              ? fragment.last
                                                             : fragment.first;
        Fragment below = fragment;
        Fragment above = fragment;
        below.last = above.first = middle;
        if (middle == fragment.last) {
            lower.push_back(fragment);
        } else if (middle == fragment.first) {
            upper.push_back(fragment);
        } else {
            below.box.upper[axis] = above.box.lower[axis] = cut.at[axis];
            below.weight = weight_of(points, below.first, below.last);
            above.weight = weight_of(points, above.first, above.last);
            lower.push_back(below);
            upper.push_back(above);
        }
    }
    return {std::move(lower), std::move(upper)};
}

void write_part(const std::vector<Fragment>& fragments, Part part, const SortedPoints& points,
                std::span<Part> parts) {
    for (const Fragment& fragment : fragments)
        for (LocalIndex i = fragment.first; i < fragment.last; ++i)
            parts[points.original[i]] = part;
}

}  // namespace rrcb
