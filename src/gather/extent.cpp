#include "gather/extent.hpp"

#include "arithmetic/position_order.hpp"

#include <algorithm>

namespace rrcb {

namespace {

/// Calls `visit` with each of the doubles that make up an extent.
template <class AnyExtent, class Visit>
void for_each_double(AnyExtent& extent, int dimension, Visit&& visit) {
    visit(extent.count);
    visit(extent.weight);
    for (int a = 0; a < dimension; ++a) {
        for (int b = 0; b < dimension; ++b) {
            visit(extent.first[a][b]);
            visit(extent.last[a][b]);
        }
    }
}

}  // namespace

Box Extent::box() const {
    Box box;
    for (std::size_t a = 0; a < max_dimension; ++a) {
        box.lower[a] = first[a][a];
        box.upper[a] = last[a][a];
    }
    return box;
}

Extent extent_of(const PointSummary& summary) {
    return {static_cast<double>(summary.count), summary.weight, summary.first, summary.last};
}

void join(Extent& extent, const Extent& other, int dimension) {
    extent.count += other.count;
    extent.weight += other.weight;
    for (int a = 0; a < dimension; ++a) {
        const PositionOrder is_before(a, 0, dimension);
        extent.first[a] = std::min(extent.first[a], other.first[a], is_before);
        extent.last[a] = std::max(extent.last[a], other.last[a], is_before);
    }
}

void append_extent(const Extent& extent, int dimension, std::vector<double>& doubles) {
    for_each_double(extent, dimension, [&](double value) { doubles.push_back(value); });
}

std::vector<Extent> read_extents(std::span<const double> doubles, int dimension) {
    std::vector<Extent> extents;
    for (auto from = doubles.begin(); from != doubles.end();) {
        Extent& extent = extents.emplace_back();
        for_each_double(extent, dimension, [&](double& value) { value = *from++; });
    }
    return extents;
}

}  // namespace rrcb
