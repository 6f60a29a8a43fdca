#include "gather/place.hpp"

#include "cells/running_sums.hpp"
#include "cuts/position_order.hpp"

#include <algorithm>

namespace rrcb {

namespace {

/// Range of consecutive points.
Points range_of(const Points& points, LocalIndex first, LocalIndex last) {
    Points range = points;
    range.count = last - first;
    for (std::size_t a = 0; a < static_cast<std::size_t>(points.dimension); ++a)
        range.axes[a] = points.axes[a].subspan(first * points.stride);
    return range;
}

/// Looks for the ends across `axis` of the order of the points in `box`.
void widen(const Points& points, const Box& box, int axis, Place& place) {
    const auto a = static_cast<std::size_t>(axis);
    const PositionOrder is_before(axis, 1, points.dimension);
    for (LocalIndex i = 0; i < points.count; ++i) {
        const double value = points.coordinate(i, axis);
        if (value != box.lower[a] && value != box.upper[a]) continue;
        const Vector position = points.position(i);
        const bool is_first = value == box.lower[a];
        const bool is_last = value == box.upper[a];
        if (is_first && (place.first[a][a] != value || is_before(position, place.first[a])))
            place.first[a] = position;
        if (is_last && (place.last[a][a] != value || is_before(place.last[a], position)))
            place.last[a] = position;
    }
}

/// Calls `visit` with each of the doubles that make up a place.
template <class AnyPlace, class Visit>
void for_each_double(AnyPlace& place, int dimension, Visit&& visit) {
    visit(place.count);
    visit(place.weight);
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
        for (std::size_t b = 0; b < static_cast<std::size_t>(dimension); ++b) {
            visit(place.first[a][b]);
            visit(place.last[a][b]);
        }
    }
}

}  // namespace

Box Place::box() const {
    Box box;
    for (std::size_t a = 0; a < max_dimension; ++a) {
        box.lower[a] = first[a][a];
        box.upper[a] = last[a][a];
    }
    return box;
}

Place place_of(const Points& points, const Box& box, double weight) {
    constexpr LocalIndex block_length = 256;
    Place place;
    place.count = static_cast<double>(points.count);
    place.weight = weight;
    // The faces of the box hold few points, and their blocks are found at the cost of its own.
    in_ranges(points.count, block_length, [&](LocalIndex first, LocalIndex last) {
        const Points block = range_of(points, first, last);
        const Box its_own = bounding_box(block);
        for (int axis = 0; axis < points.dimension; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            if (its_own.lower[a] == box.lower[a] || its_own.upper[a] == box.upper[a])
                widen(block, box, axis, place);
        }
    });
    return place;
}

void join(Place& place, const Place& other, int dimension) {
    place.count += other.count;
    place.weight += other.weight;
    for (int axis = 0; axis < dimension; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const PositionOrder is_before(axis, 0, dimension);
        place.first[a] = std::min(place.first[a], other.first[a], is_before);
        place.last[a] = std::max(place.last[a], other.last[a], is_before);
    }
}

void append_place(const Place& place, int dimension, std::vector<double>& doubles) {
    for_each_double(place, dimension, [&](double value) { doubles.push_back(value); });
}

std::vector<Place> read_places(std::span<const double> doubles, int dimension) {
    std::vector<Place> places;
    for (auto from = doubles.begin(); from != doubles.end();) {
        Place& place = places.emplace_back();
        for_each_double(place, dimension, [&](double& value) { value = *from++; });
    }
    return places;
}

}  // namespace rrcb
