#pragma once

#include "../support/common.hpp"

#include <rrcb/detail/moments.hpp>

namespace rrcb::test {

/// Moments of some points in long double, whose range and digits go beyond those of double.
struct ReferenceMoments {
    long double weight = 0;
    std::vector<long double> mean;
    std::vector<long double> deviation;
};

/// Sum of term(first) ... term(last - 1) in pairs, so that millions of terms cost no digits.
template <class Term>
long double pairwise_sum(std::size_t first, std::size_t last, const Term& term) {
    if (last - first > 16) {
        const std::size_t middle = first + (last - first) / 2;
        return pairwise_sum(first, middle, term) + pairwise_sum(middle, last, term);
    }
    long double sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += term(i);
    return sum;
}

/// Two passes over the points `members`, relative to the first of them.
inline ReferenceMoments reference_moments(const Points& points,
                                          const std::vector<LocalIndex>& members) {
    const auto sum = [&](const auto& term) {
        return pairwise_sum(0, members.size(), [&](std::size_t k) { return term(members[k]); });
    };
    ReferenceMoments reference;
    reference.weight =
        sum([&](LocalIndex i) { return static_cast<long double>(points.weight(i)); });
    for (int axis = 0; axis < points.dimension; ++axis) {
        const long double origin = points.coordinate(members[0], axis);
        const auto offset = [&](LocalIndex i) { return points.coordinate(i, axis) - origin; };
        const long double mean =
            sum([&](LocalIndex i) { return points.weight(i) * offset(i); }) / reference.weight;
        const long double square = sum([&](LocalIndex i) {
            const long double difference = offset(i) - mean;
            return points.weight(i) * difference * difference;
        });
        reference.mean.push_back(origin + mean);
        reference.deviation.push_back(std::sqrt(square / reference.weight));
    }
    return reference;
}

/// Deviations within 1e-12, of the cell's extent where all its points are equal; means as fine as
/// the coordinates they are made of.
inline void expect_near_reference(const CellMoments& cell, const ReferenceMoments& reference) {
    const Moments& moments = cell.moments;
    EXPECT_NEAR(moments.weight, static_cast<double>(reference.weight), 1e-13 * moments.weight);
    for (std::size_t a = 0; a < reference.mean.size(); ++a) {
        const auto mean = static_cast<double>(reference.mean[a]);
        const auto deviation = static_cast<double>(reference.deviation[a]);
        const double largest = std::max(std::abs(cell.box.lower[a]), std::abs(cell.box.upper[a]));
        const double extent = cell.box.upper[a] / 2 - cell.box.lower[a] / 2;
        EXPECT_GE(moments.deviation[a], 0);
        EXPECT_NEAR(moments.mean[a], mean, 1e-15 * largest + 1e-14 * deviation);
        EXPECT_NEAR(moments.deviation[a], deviation, 1e-12 * (deviation > 0 ? deviation : extent));
    }
}

/// Lays a mesh over the points and compares every cell.
inline void expect_reference_moments(const Points& points, int cells_per_axis) {
    const SupportMesh mesh =
        make_support_mesh(bounding_box(points), points.dimension, cells_per_axis);
    std::vector<std::vector<LocalIndex>> members(num_cells(mesh));
    for (LocalIndex i = 0; i < points.count; ++i)
        members[cell_of(mesh, points.position(i))].push_back(i);
    std::size_t next = 0;
    const std::vector<CellMoments> cells = cell_moments(points, mesh);
    for (LocalIndex cell = 0; cell < members.size(); ++cell) {
        if (members[cell].empty()) continue;
        SCOPED_TRACE("cell " + std::to_string(cell));
        const CellMoments& ours = cells.at(next++);
        EXPECT_EQ(ours.cell, cell);
        EXPECT_EQ(ours.moments.count, static_cast<GlobalCount>(members[cell].size()));
        expect_near_reference(ours, reference_moments(points, members[cell]));
    }
    EXPECT_EQ(next, cells.size());
}

}  // namespace rrcb::test
