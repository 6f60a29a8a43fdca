#include "cloud.hpp"

#include <numbers>
#include <stdexcept>

namespace rrcb::hard_test {

namespace {

constexpr double largest = std::numeric_limits<double>::max();
constexpr double smallest = std::numeric_limits<double>::denorm_min();

Vector uniform_position(int i) {
    return {uniform(i, 0), uniform(i, 1), uniform(i, 2)};
}

Vector on_a_lattice(int i) {
    return {double(i % 8), double(i / 8 % 8), double(i / 64)};
}

/// A point of Cantor's set: its digits to the base 3 are 0 or 2.
double cantor(double u) {
    double x = 0;
    for (double digit = 1; digit < 20; ++digit) {
        x += u < 0.5 ? 0 : 2 * std::pow(3, -digit);
        u = u < 0.5 ? 2 * u : 2 * u - 1;
    }
    return x;
}

Vector on_a_sphere(int i) {
    const double z = 2 * uniform(i, 0) - 1;
    const double angle = 2 * std::numbers::pi * uniform(i, 1);
    const double radius = std::sqrt(1 - z * z);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

Vector along_an_l(int i) {
    const double along = 10 * uniform(i, 0);
    return i % 2 == 0 ? Vector{along, uniform(i, 1)} : Vector{uniform(i, 1), along};
}

/// +-DBL_MAX, and numbers of that size between.
Vector over_the_whole_range(int i) {
    if (i < 8) return {i % 2 == 0 ? largest : -largest, i % 4 < 2 ? largest : -largest};
    return {(2 * uniform(i, 0) - 1) * largest, (2 * uniform(i, 1) - 1) * largest};
}

constexpr std::array by_position = {
    Cloud{"coincident", 2,
          [](int) {
              return Vector{0.25, 0.75};
          }},
    Cloud{"many_in_few_places", 2,
          [](int i) {
              return Vector{double(i % 5), double(i % 3)};
          }},
    Cloud{"half_of_them_on_the_cuts", 2,
          [](int i) {
              return i % 2 == 0 ? uniform_position(i) : Vector{0.5, double(i % 50) / 50};
          }},
    Cloud{"lattice", 3, on_a_lattice, nullptr, [](int) { return 512; }},
    Cloud{"collinear_along_an_axis", 3,
          [](int i) {
              return Vector{3, uniform(i, 0), -2};
          }},
    Cloud{"collinear_across_the_axes", 3,
          [](int i) {
              return Vector{1. * i, 2. * i, -3. * i};
          }},
    Cloud{"coplanar", 3,
          [](int i) {
              return Vector{uniform(i, 0), 7, uniform(i, 1)};
          }},
    Cloud{"far_from_the_origin", 2,
          [](int i) {
              return Vector{1e9 + 1e-3 * uniform(i, 0), -1e9 + 1e-3 * uniform(i, 1)};
          }},
    Cloud{"subnormal", 2,
          [](int i) {
              return Vector{smallest * (i / 20), smallest * (i % 20)};
          }},
    Cloud{"whole_range", 2, over_the_whole_range},
    Cloud{"cantor_dust", 2,
          [](int i) {
              return Vector{cantor(uniform(i, 0)), cantor(uniform(i, 1))};
          }},
    Cloud{"spiral", 2,
          [](int i) {
              return Vector{i * std::cos(0.1 * i), i * std::sin(0.1 * i)};
          }},
    Cloud{"hollow_shell", 3, on_a_sphere},
    Cloud{"two_far_clusters", 2,
          [](int i) {
              return Vector{1e6 * (i % 2) + 1e-6 * uniform(i, 0), 1e-6 * uniform(i, 1)};
          }},
    Cloud{"power_law", 3,
          [](int i) {
              return Vector{std::pow(uniform(i, 0), 12), std::pow(uniform(i, 1), 12),
                            std::pow(uniform(i, 2), 12)};
          }},
    Cloud{"l_shaped", 2, along_an_l},
};

constexpr std::array by_weight = {
    Cloud{"weights_of_60_decades", 2, uniform_position,
          [](int i) { return std::pow(10, 60 * uniform(i, 9) - 30); }},
    Cloud{"one_giant_weight", 2, uniform_position, [](int i) { return i == 300 ? 1e6 : 1.0; }},
    Cloud{"half_the_weights_zero", 2, uniform_position,
          [](int i) { return i % 2 == 0 ? 0.0 : 1.0; }},
    Cloud{"one_weight_not_zero", 2, uniform_position, [](int i) { return i == 7 ? 2.5 : 0.0; }},
    Cloud{"weights_all_zero", 2, uniform_position, [](int) { return 0.0; }},
    Cloud{"weights_across_the_positions", 1, uniform_position,
          [](int i) { return std::pow(1e-3, uniform(i, 0)); }},
};

constexpr std::array by_distribution = {
    Cloud{"none", 2, uniform_position, nullptr, [](int) { return 0; }},
    Cloud{"one", 3, uniform_position, nullptr, [](int) { return 1; }},
    Cloud{"two", 1, uniform_position, nullptr, [](int) { return 2; }},
    Cloud{"one_less_than_parts", 2, uniform_position, nullptr, [](int p) { return p - 1; }},
    Cloud{"one_per_part", 2, uniform_position, nullptr, [](int p) { return p; }},
    Cloud{"all_on_one_rank", 3, uniform_position, nullptr, [](int) { return 600; }, true},
    Cloud{"weights_all_on_one_rank", 2, uniform_position, [](int i) { return 1. + i % 3; },
          [](int) { return 600; }, true},
};

constexpr std::array all_lists = {std::span<const Cloud>(by_position),
                                  std::span<const Cloud>(by_weight),
                                  std::span<const Cloud>(by_distribution)};

}  // namespace

std::span<const Cloud> clouds_hard_by_position() {
    return by_position;
}

std::span<const Cloud> clouds_hard_by_weight() {
    return by_weight;
}

std::span<const Cloud> clouds_hard_by_distribution() {
    return by_distribution;
}

std::vector<std::string> names_of(std::span<const Cloud> clouds) {
    std::vector<std::string> names;
    for (const Cloud& cloud : clouds) names.emplace_back(cloud.name);
    return names;
}

const Cloud& find_cloud(std::string_view name) {
    for (const std::span<const Cloud> list : all_lists)
        for (const Cloud& cloud : list)
            if (cloud.name == name) return cloud;
    throw std::invalid_argument("no cloud is called " + std::string(name));
}

double weight_of(const Cloud& cloud, int point) {
    return cloud.weight == nullptr ? 1 : cloud.weight(point);
}

double heaviest_place(const Cloud& cloud, int count) {
    std::map<Vector, double> places;
    double heaviest = 0;
    for (int i = 0; i < count; ++i)
        heaviest = std::max(heaviest, places[cloud.position(i)] += weight_of(cloud, i));
    return heaviest;
}

double uniform(int point, int purpose) {
    // Steele, Lea, Flood: Fast splittable pseudorandom number generators (2014), figure 13.
    std::uint64_t z =
        (static_cast<std::uint64_t>(point) * 16 + static_cast<std::uint64_t>(purpose)) *
        0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

}  // namespace rrcb::hard_test
