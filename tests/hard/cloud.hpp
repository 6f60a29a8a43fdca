#pragma once

#include "../support/common.hpp"

#include <rrcb/points.hpp>

#include <string_view>

namespace rrcb::hard_test {

/// A cloud that is hard to divide, the same on every machine and for every number of ranks: each
/// rank can make any point of it by its number.
struct Cloud {
    const char* name;
    int dimension;
    Vector (*position)(int point);
    double (*weight)(int point) = nullptr;  ///< null: every point weighs 1
    int (*count)(int num_parts) = [](int) { return 600; };
    bool on_last_rank = false;  ///< that one holds every point
};

std::span<const Cloud> clouds_hard_by_position();
std::span<const Cloud> clouds_hard_by_weight();
std::span<const Cloud> clouds_hard_by_distribution();

std::vector<std::string> names_of(std::span<const Cloud> clouds);
const Cloud& find_cloud(std::string_view name);

double weight_of(const Cloud& cloud, int point);

/// Largest weight of the points in one place, which no cut divides.
double heaviest_place(const Cloud& cloud, int count);

/// Uniform in [0, 1), a number of its own for each point and purpose.
double uniform(int point, int purpose);

}  // namespace rrcb::hard_test
