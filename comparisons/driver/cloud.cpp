#include "cloud.hpp"

#include "counter_random.hpp"
#include "failure.hpp"
#include "text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace comparisons {

namespace {

using rrcb::GlobalCount;
using rrcb::Vector;

constexpr double side = 100;

Vector uniform_point(const Cloud&, GlobalCount, CounterRandom& random) {
    return {random.uniform(0, side), random.uniform(0, side), random.uniform(0, side)};
}

// The outline consists of a base of 110 m x 15 m, a crest of 30 m x 20 m on it, and a sloping face
// of 20 m x 20 m. Axis 0 points to the toe, the last axis upwards.
Vector slope_point(const Cloud& cloud, GlobalCount, CounterRandom& random) {
    constexpr double base_area = 110 * 15;
    constexpr double crest_area = 30 * 20;
    constexpr double face_area = 20 * 20 / 2;
    const double where = random.uniform(0, base_area + crest_area + face_area);
    const double s = random.uniform();
    const double t = random.uniform();
    double x = 110 * s;
    double z = -15 * t;
    if (where >= base_area + crest_area) {
        const double height = std::sqrt(1 - s);
        x = 30 + 20 * (1 - height);
        z = 20 * height * t;
    } else if (where >= base_area) {
        x = 30 * s;
        z = 20 * t;
    }
    return cloud.dimension == 2 ? Vector{x, z, 0} : Vector{x, random.uniform(0, 40), z};
}

struct Cluster {
    double share;  ///< share of the points
    double width;  ///< standard deviation
    Vector centre;
};

constexpr Cluster clusters[] = {
    {0.40, 1, {20, 30, 40}},  {0.25, 5, {75, 70, 20}}, {0.15, 0.2, {60, 15, 80}},
    {0.10, 12, {25, 80, 65}}, {0.10, 3, {90, 30, 50}},
};

// See Box and Muller: A note on the generation of random normal deviates (1958).
double normal(CounterRandom& random) {
    const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
    return radius * std::cos(2 * std::numbers::pi * random.uniform());
}

Vector cluster_point(const Cloud&, GlobalCount, CounterRandom& random) {
    double where = random.uniform();
    const Cluster* cluster = std::begin(clusters);
    while (where >= cluster->share && cluster + 1 != std::end(clusters)) {
        where -= cluster->share;
        ++cluster;
    }
    Vector x = cluster->centre;
    for (double& coordinate : x) coordinate += cluster->width * normal(random);
    return x;
}

/// Returns a point of a heap that has run out to 100 m. Density is uniform below a face that
/// becomes less steep with distance.
Vector run_out_point(const Cloud& cloud, GlobalCount, CounterRandom& random) {
    constexpr double length = 25;
    const double x = -length * std::log(1 - random.uniform() * (1 - std::exp(-side / length)));
    const double z = random.uniform() * side / 4 * std::exp(-x / length);
    return cloud.dimension == 2 ? Vector{x, z, 0} : Vector{x, random.uniform(0, 40), z};
}

bool is_in_polygon(double x, double y) {
    constexpr double corners[][2] = {{5, 10},  {50, 0},  {95, 20}, {80, 55},
                                     {90, 95}, {45, 75}, {10, 90}, {25, 45}};
    bool inside = false;
    const double* last = std::end(corners)[-1];
    for (const auto& corner : corners) {
        const bool crosses = (corner[1] > y) != (last[1] > y);
        const double share = (y - corner[1]) / (last[1] - corner[1]);
        inside = inside != (crosses && x < corner[0] + share * (last[0] - corner[0]));
        last = corner;
    }
    return inside;
}

/// Returns a point of a star-shaped polygon, five times as dense on the right as on the left.
Vector polygon_point(const Cloud& cloud, GlobalCount, CounterRandom& random) {
    for (;;) {
        const double x = random.uniform(0, side);
        const double y = random.uniform(0, side);
        if (is_in_polygon(x, y) && random.uniform(0, side) < 20 + 0.8 * x)
            return cloud.dimension == 2 ? Vector{x, y, 0} : Vector{x, random.uniform(0, 40), y};
    }
}

/// Returns a point between two circles or spheres with radii of 40 and 50 m.
Vector shell_point(const Cloud& cloud, GlobalCount, CounterRandom& random) {
    const double inner = std::pow(0.8, cloud.dimension);
    const double radius = 50 * std::pow(random.uniform(inner, 1), 1.0 / cloud.dimension);
    const double angle = 2 * std::numbers::pi * random.uniform();
    const double height = cloud.dimension == 2 ? 0 : random.uniform(-1, 1);
    const double flat = radius * std::sqrt(1 - height * height);
    return {flat * std::cos(angle), flat * std::sin(angle), radius * height};
}

/// Returns a point of a spiral arm with two turns and a normal profile. In 3-D the arm rises by 100
/// m.
Vector spiral_point(const Cloud&, GlobalCount, CounterRandom& random) {
    const double along = std::sqrt(random.uniform());
    const double angle = 4 * std::numbers::pi * along;
    constexpr double width = 1;
    return {50 * along * std::cos(angle) + width * normal(random),
            50 * along * std::sin(angle) + width * normal(random),
            100 * along + width * normal(random)};
}

/// Returns a point uniformly distributed in y and up to a height; in 2-D only up to a height.
Vector below(const Cloud& cloud, double x, double height, CounterRandom& random) {
    const double z = random.uniform(0, height);
    return cloud.dimension == 2 ? Vector{x, z, 0} : Vector{x, random.uniform(0, side), z};
}

Vector slab_point(const Cloud& cloud, GlobalCount, CounterRandom& random) {
    return below(cloud, random.uniform(0, side), side / 10, random);
}

Vector wave_point(const Cloud& cloud, GlobalCount, CounterRandom& random) {
    const double x = random.uniform(0, side);
    return below(cloud, x, 6 + 4 * std::sin(4 * std::numbers::pi * x / side), random);
}

/// Returns a point of a layer of 3 m; one in 200 points is a drop above the layer.
Vector drops_point(const Cloud& cloud, GlobalCount index, CounterRandom& random) {
    return below(cloud, random.uniform(0, side), index % 200 == 0 ? side : 3, random);
}

/// Returns a point of a triangle or cone of 100 m x 25 m; one in 100 points is a grain anywhere.
Vector pile_point(const Cloud& cloud, GlobalCount index, CounterRandom& random) {
    if (index % 100 == 0) return below(cloud, random.uniform(0, side), side, random);
    const double rest = std::pow(1 - random.uniform(), 1.0 / cloud.dimension);
    const double z = side / 4 * (1 - rest);
    const double t = random.uniform(-1, 1);
    if (cloud.dimension == 2) return {side / 2 * (1 + rest * t), z, 0};
    const double radius = side / 2 * rest * std::sqrt(std::abs(t));
    const double angle = 2 * std::numbers::pi * random.uniform();
    return {side / 2 + radius * std::cos(angle), side / 2 + radius * std::sin(angle), z};
}

/// Returns a point of a layer of 4 m along a diagonal of the square or cube.
Vector diagonal_point(const Cloud&, GlobalCount, CounterRandom& random) {
    const double along = random.uniform(0, side);
    const double across = random.uniform(-1.4, 1.4);
    return {along + across, along - across, random.uniform(0, side)};
}

/// Returns a point of a cloud that is dense at the faces of one corner.
Vector cusps_point(const Cloud& cloud, GlobalCount index, CounterRandom& random) {
    Vector x = uniform_point(cloud, index, random);
    for (double& coordinate : x) coordinate = side * std::pow(coordinate / side, 4);
    return x;
}

/// Returns a point of two jets, 2 m and 1 m wide, that meet at right angles, or of the sheet that
/// they feed.
Vector jets_point(const Cloud&, GlobalCount, CounterRandom& random) {
    const double where = random.uniform();
    const Vector across{normal(random), normal(random), normal(random)};
    const double along = random.uniform(0, side);
    if (where < 0.5) return {along, 30 + across[1], 40 + across[2]};
    if (where < 0.8) return {80 + across[0] / 2, along, 40 + across[2] / 2};
    return {80 + across[0] / 2, random.uniform(0, 30), random.uniform(20, 60)};
}

/// Returns a point of filaments of 1 m between six nodes. A third of the points is at the nodes.
Vector web_point(const Cloud&, GlobalCount, CounterRandom& random) {
    constexpr Vector nodes[] = {{10, 15, 60}, {55, 5, 20},  {90, 40, 85},
                                {60, 60, 50}, {20, 85, 10}, {85, 95, 30}};
    constexpr std::size_t edges[][2] = {{0, 1}, {0, 3}, {1, 2}, {1, 3}, {2, 3},
                                        {2, 5}, {3, 4}, {3, 5}, {0, 4}};
    const auto& [first, last] = edges[static_cast<std::size_t>(random.uniform(0, 9))];
    const bool is_at_node = random.uniform() < 1.0 / 3;
    const double t = is_at_node ? 0 : random.uniform();
    const double width = is_at_node ? 2 * random.uniform() : 0.5;
    Vector x;
    for (std::size_t a = 0; a < x.size(); ++a)
        x[a] = std::lerp(nodes[first][a], nodes[last][a], t) + width * normal(random);
    return x;
}

/// Returns a point of two discs of stars. One is in the plane of axes 0 and 1, the smaller one
/// along a diagonal.
Vector discs_point(const Cloud&, GlobalCount, CounterRandom& random) {
    const bool is_first = random.uniform() < 0.7;
    const double scale = is_first ? 12 : 7;
    const double radius = -scale * std::log(random.uniform(0.02, 1) * random.uniform(0.02, 1));
    const double angle = 2 * std::numbers::pi * random.uniform();
    const double u = radius * std::cos(angle);
    const double v = radius * std::sin(angle);
    const double w = 0.7 * normal(random);
    if (is_first) return {40 + u, 40 + v, 30 + w};
    const double half = std::sqrt(0.5);
    return {95 + half * (u - w), 80 + v, 70 + half * (u + w)};
}

GlobalCount lattice_side(const Cloud& cloud) {
    const auto full = [&](GlobalCount n) { return cloud.dimension == 2 ? n * n : n * n * n; };
    const double estimate = std::pow(static_cast<double>(cloud.num_points), 1.0 / cloud.dimension);
    GlobalCount n = std::max<GlobalCount>(1, static_cast<GlobalCount>(estimate) - 1);
    while (full(n) < cloud.num_points) ++n;
    return n;
}

Vector lattice_point(const Cloud& cloud, GlobalCount index, CounterRandom&) {
    const GlobalCount per_axis = lattice_side(cloud);
    Vector x{};
    for (double& coordinate : x) {
        coordinate = static_cast<double>(index % per_axis);
        index /= per_axis;
    }
    return x;
}

struct Generator {
    std::string_view name;
    Vector (*point)(const Cloud&, GlobalCount, CounterRandom&);
};

constexpr Generator generators[] = {
    {"uniform", uniform_point},   {"slope", slope_point},     {"clusters", cluster_point},
    {"lattice", lattice_point},   {"run_out", run_out_point}, {"polygon", polygon_point},
    {"shell", shell_point},       {"spiral", spiral_point},   {"slab", slab_point},
    {"wave", wave_point},         {"drops", drops_point},     {"pile", pile_point},
    {"diagonal", diagonal_point}, {"cusps", cusps_point},     {"jets", jets_point},
    {"web", web_point},           {"discs", discs_point},
};

}  // namespace

std::string cloud_names() {
    return joined(generators, &Generator::name);
}

std::vector<double> cloud_points(const Cloud& cloud, GlobalCount first, GlobalCount last) {
    const auto* generator = std::ranges::find(generators, cloud.name, &Generator::name);
    if (generator == std::end(generators)) {
        throw Failure("--cloud: unknown cloud '" + cloud.name + "'; choose from: " + cloud_names());
    }
    std::vector<double> coordinates;
    coordinates.reserve(static_cast<std::size_t>((last - first) * cloud.dimension));
    for (GlobalCount i = first; i < last; ++i) {
        CounterRandom random(cloud.seed, static_cast<std::uint64_t>(i));
        const Vector x = generator->point(cloud, i, random);
        coordinates.insert(coordinates.end(), x.begin(), x.begin() + cloud.dimension);
    }
    return coordinates;
}

}  // namespace comparisons
