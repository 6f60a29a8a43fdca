#include "estimate/extent.hpp"

#include "arithmetic/position_order.hpp"

#include <algorithm>

namespace rrcb {

namespace {

/// Calls `visit` with each of the doubles that make up an extent; its count is in `count`.
template <class Visit>
void for_each_double(PointSummary& extent, double& count, int dimension, Visit&& visit) {
    visit(count);
    visit(extent.weight);
    for (int a = 0; a < dimension; ++a) {
        for (int b = 0; b < dimension; ++b) {
            visit(extent.first[a][b]);
            visit(extent.last[a][b]);
        }
    }
}

}  // namespace

void join(PointSummary& extent, const PointSummary& other, int dimension) {
    extent.count += other.count;
    extent.weight += other.weight;
    for (int a = 0; a < dimension; ++a) {
        const PositionOrder is_before(a, 0, dimension);
        extent.first[a] = std::min(extent.first[a], other.first[a], is_before);
        extent.last[a] = std::max(extent.last[a], other.last[a], is_before);
    }
}

void append_extent(PointSummary extent, int dimension, std::vector<double>& doubles) {
    auto count = static_cast<double>(extent.count);
    for_each_double(extent, count, dimension, [&](double value) { doubles.push_back(value); });
}

std::vector<PointSummary> read_extents(std::span<const double> doubles, int dimension) {
    std::vector<PointSummary> extents;
    for (auto from = doubles.begin(); from != doubles.end();) {
        PointSummary& extent = extents.emplace_back();
        double count = 0;
        for_each_double(extent, count, dimension, [&](double& value) { value = *from++; });
        extent.count = static_cast<LocalIndex>(count);
    }
    return extents;
}

}  // namespace rrcb
