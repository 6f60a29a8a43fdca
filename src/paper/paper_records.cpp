#include "paper/paper_records.hpp"

#include "options/rejection.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace rrcb {

namespace {

/// Totals of a rank, ahead of its cells or points.
struct RecordHead {
    double num_points = 0;
    double weight = 0;
    double heaviest = 0;
    double has_weights = 0;  ///< 1: each position is followed by its weight
    double num_doubles = 0;  ///< behind the head
};
constexpr std::size_t head_length = sizeof(RecordHead) / sizeof(double);
using HeadNumbers = std::array<double, head_length>;

RecordHead head_of(const Points& points) {
    RecordHead head;
    head.num_points = static_cast<double>(points.count);
    head.has_weights = points.weights.empty() ? 0 : 1;
    head.weight = points.weights.empty()
                      ? head.num_points
                      : std::accumulate(points.weights.begin(), points.weights.end(), 0.0);
    if (points.count > 0)
        head.heaviest = points.weights.empty() ? 1 : std::ranges::max(points.weights);
    return head;
}

/// Writes the head in front of the records.
void complete(std::vector<double>& packed, const Points& points) {
    RecordHead head = head_of(points);
    head.num_doubles = static_cast<double>(packed.size() - head_length);
    std::ranges::copy(std::bit_cast<HeadNumbers>(head), packed.begin());
}

/// Calls unpack_block(head, doubles, all) for the data of each rank.
template <class UnpackBlock>
PaperRecords unpack(std::span<const double> packed, UnpackBlock&& unpack_block) {
    PaperRecords all;
    while (!packed.empty()) {
        HeadNumbers numbers;
        std::ranges::copy(packed.first(head_length), numbers.begin());
        const auto head = std::bit_cast<RecordHead>(numbers);
        const auto length = static_cast<std::size_t>(head.num_doubles);
        all.num_points += static_cast<GlobalCount>(head.num_points);
        all.weight += head.weight;
        all.heaviest = std::max(all.heaviest, head.heaviest);
        unpack_block(head, packed.subspan(head_length, length), all);
        packed = packed.subspan(head_length + length);
    }
    require(std::isfinite(all.weight),
            "the sum of the weights of all ranks overflows; scale them down");
    return all;
}

}  // namespace

std::vector<double> pack_moments(const Points& points, std::span<const CellMoments> cells) {
    std::vector<double> packed(head_length);
    for (const CellMoments& cell : cells) {
        const auto& [count, weight, mean, deviation] = cell.moments;
        packed.insert(packed.end(), {static_cast<double>(count), weight});
        packed.insert(packed.end(), mean.begin(), mean.begin() + points.dimension);
        packed.insert(packed.end(), deviation.begin(), deviation.begin() + points.dimension);
    }
    complete(packed, points);
    return packed;
}

std::vector<double> pack_points(const Points& points) {
    std::vector<double> packed(head_length);
    for (LocalIndex i = 0; i < points.count; ++i) {
        for (int axis = 0; axis < points.dimension; ++axis)
            packed.push_back(points.coordinate(i, axis));
        if (!points.weights.empty()) packed.push_back(points.weights[i]);
    }
    complete(packed, points);
    return packed;
}

PaperRecords unpack_moments(std::span<const double> packed, int dimension) {
    const std::size_t length = 2 + 2 * dimension;
    return unpack(packed, [&](const RecordHead&, std::span<const double> doubles,
                              PaperRecords& all) {
        for (; !doubles.empty(); doubles = doubles.subspan(length)) {
            Moments& moments = all.cells.emplace_back().moments;
            moments.count = static_cast<GlobalCount>(doubles[0]);
            moments.weight = doubles[1];
            std::ranges::copy(doubles.subspan(2, dimension), moments.mean.begin());
            std::ranges::copy(doubles.subspan(2 + dimension, dimension), moments.deviation.begin());
        }
    });
}

PaperRecords unpack_points(std::span<const double> packed, int dimension) {
    return unpack(packed,
                  [&](const RecordHead& head, std::span<const double> doubles, PaperRecords& all) {
                      const std::size_t length = dimension + (head.has_weights != 0 ? 1 : 0);
                      for (; !doubles.empty(); doubles = doubles.subspan(length)) {
                          all.coordinates.insert(all.coordinates.end(), doubles.begin(),
                                                 doubles.begin() + dimension);
                          all.weights.push_back(head.has_weights != 0 ? doubles[dimension] : 1.0);
                      }
                  });
}

}  // namespace rrcb
