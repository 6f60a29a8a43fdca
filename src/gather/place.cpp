#include "gather/place.hpp"

#include "cells/point_layout.hpp"
#include "cells/running_sums.hpp"
#include "cuts/position_order.hpp"

#include <algorithm>

namespace rrcb {

namespace {

/// Whether any of consecutive points lies on a face of the box across `axis`.
template <class Layout>
bool any_on_face(const Layout& x, const Box& box, int axis, LocalIndex first, LocalIndex last) {
    const double lower = box.lower[static_cast<std::size_t>(axis)];
    const double upper = box.upper[static_cast<std::size_t>(axis)];
    std::int64_t found = 0;
    // No way out before the end, so that the loop can be one of vectors.
    for (LocalIndex i = first; i < last; ++i) {
        const double value = x(i, axis);
        found |= static_cast<std::int64_t>(value == lower) | (value == upper);
    }
    return found != 0;
}

/// Looks for the ends across `axis` among consecutive points.
void widen(const Points& points, const Box& box, int axis, LocalIndex first, LocalIndex last,
           Place& place) {
    const auto a = static_cast<std::size_t>(axis);
    const PositionOrder is_before(axis, 1, points.dimension);
    for (LocalIndex i = first; i < last; ++i) {
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

/// Calls `visit` with each of the doubles that tell a place.
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
    visit_layout(points, [&]<class Layout>(const Layout& x) {
        in_ranges(points.count, block_length, [&](LocalIndex first, LocalIndex last) {
            for (int axis = 0; axis < Layout::dimension; ++axis)
                if (any_on_face(x, box, axis, first, last))
                    widen(points, box, axis, first, last, place);
        });
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
