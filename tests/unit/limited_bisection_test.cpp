#include "bisection/limited_bisection.hpp"

#include "../support/memory_layer.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rrcb {
namespace {

/// A dense and a thin cell of the unit box, which leave the search the most to try.
StatisticalDomain two_cells(int dimension) {
    StatisticalDomain domain{dimension};
    domain.patches.push_back({{0, 0, 0}, {0.25, 1, 1}, 900, {}, {}});
    domain.patches.push_back({{0.25, 0, 0}, {1, 1, 1}, 100, {}, {}});
    return domain;
}

/// Widths and lines that leave little more room than the parts need.
Options tight_options(int num_parts, int dimension) {
    Options options{.num_parts = num_parts};
    options.part_sizes.assign(static_cast<std::size_t>(num_parts), 1.0);
    const double along = std::ceil(1.5 * std::pow(num_parts, 1.0 / dimension)) + 1;
    for (int axis = 0; axis < dimension; ++axis) {
        options.expert.axes.min_width.push_back(0.95 / along);
        options.expert.axes.grid.push_back({0.001, 0.01 / along});
    }
    options.expert.axes.plain = true;
    return options;
}

/// Each look at a place allocates, so that allocations measure the work.
std::size_t allocations_of(int num_parts, int dimension) {
    const Options options = tight_options(num_parts, dimension);
    const Box box{{0, 0, 0}, {1, 1, 1}};
    memory_layer::fail_allocation(0);
    const Bisection found = bisect_within(box, two_cells(dimension), options, true);
    EXPECT_EQ(found.part_weights.size(), static_cast<std::size_t>(num_parts));
    return static_cast<std::size_t>(memory_layer::counted_allocations());
}

TEST(LimitedBisection, looks_at_a_few_places_for_each_part) {
    for (const int dimension : {1, 2, 3}) {
        for (const int num_parts : {100, 400, 1600}) {
            EXPECT_LE(allocations_of(num_parts, dimension), 60u * static_cast<unsigned>(num_parts))
                << dimension << "-D, " << num_parts << " parts";
        }
    }
}

}  // namespace
}  // namespace rrcb
