#include "flow.hpp"

#include "counter_random.hpp"
#include "failure.hpp"
#include "text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace comparisons {

using rrcb::Vector;
using std::numbers::pi;

/// A particle with its own random numbers, which are the same at every time.
struct Particle {
    std::size_t number;
    double share;  ///< share of the particles that precede it, 0 to 1
    CounterRandom random;

    double uniform(double lower, double upper) { return random.uniform(lower, upper); }

    /// Returns its position in a jittered lattice of unit spacing with a corner at the origin.
    Vector cell(std::size_t nx, std::size_t ny) {
        return {static_cast<double>(number % nx) + uniform(0.2, 0.8),
                static_cast<double>(number / nx % ny) + uniform(0.2, 0.8),
                static_cast<double>(number / nx / ny) + uniform(0.2, 0.8)};
    }

    /// Returns a random position in a ball around the origin.
    Vector ball(double radius) {
        const double z = uniform(-1, 1);
        const double angle = uniform(0, 2 * pi);
        const double r = radius * std::cbrt(uniform(0, 1));
        const double across = std::sqrt(1 - z * z);
        return {r * across * std::cos(angle), r * across * std::sin(angle), r * z};
    }
};

namespace {

/// Rotates a position in the plane of the axes `first` and `second`, from the first to the second.
Vector turned(Vector x, double angle, std::size_t first = 0, std::size_t second = 1) {
    const Vector old = x;
    x[first] = std::cos(angle) * old[first] - std::sin(angle) * old[second];
    x[second] = std::sin(angle) * old[first] + std::cos(angle) * old[second];
    return x;
}

/// Returns a particle of a dam break, moved in columns by Ritter's solution. The rarefaction wave
/// reaches the wall at time 1.
Vector dam(Particle& p, double t) {
    const Vector cell = p.cell(80, 100);
    const double behind = 80 - cell[0];
    const double rarefied = 80 * t;
    if (behind >= rarefied) return {-behind, cell[1], 0};
    const double x = 2 * rarefied - std::cbrt(27 * rarefied * rarefied * behind);
    const double depth = std::pow((2 * rarefied - x) / (3 * rarefied), 2);
    return {x, cell[1] * depth, 0};
}

/// Returns a particle of a hopper that empties from below onto a growing cone.
Vector pour(Particle& p, double t) {
    const double drained = 1.1 * t;
    const double outlet = 40;
    const double above = 20 * (p.share - drained);
    const double narrow = std::clamp(above / 5, 0.15, 1.0);
    const Vector from{narrow * p.uniform(-10, 10), narrow * p.uniform(-10, 10), 0};
    if (above >= 0) return {from[0], from[1], outlet + above};
    const double radius = 23.4 * std::cbrt(p.share);
    const double place = std::sqrt(p.uniform(0, 1));
    const double angle = p.uniform(0, 2 * pi);
    const double height = 0.6 * radius * (1 - place);
    const double fallen = 200 * above * above / 4;
    const double way = std::min(1.0, fallen / (outlet - height));
    return {std::lerp(from[0], radius * place * std::cos(angle), way),
            std::lerp(from[1], radius * place * std::sin(angle), way),
            std::lerp(outlet, height, way)};
}

/// Returns a particle of one of two rotating clusters that pass each other.
Vector galaxies(Particle& p, double t) {
    const double side = p.number % 2 == 0 ? 1 : -1;
    Vector x = p.ball(1);
    const double r = std::hypot(x[0], x[1], x[2]);
    const double stretched = 1 / std::max(0.2, std::sqrt(1.05 - r * r));
    x = {x[0] * stretched, x[1] * stretched, 0.3 * x[2] * stretched};
    x = turned(x, 8 * side * t / std::pow(0.3 + x[0] * x[0] + x[1] * x[1], 0.75));
    if (side > 0) x = turned(x, 1, 1, 2);
    return {x[0] + side * (12 * t - 6), x[1] + 1.2 * side, x[2]};
}

/// Returns a particle of a sheet that an oblique front crosses and compresses, to a third behind
/// it.
Vector front(Particle& p, double t) {
    const Vector x = p.cell(100, 80);
    const double behind = std::max(0.0, 128 * t - 0.8 * x[0] - 0.6 * x[1]);
    return {x[0] + 0.8 * behind * 2 / 3, x[1] + 0.6 * behind * 2 / 3, 0};
}

Vector shear(Particle& p, double t) {
    const Vector x = p.cell(90, 90);
    return {x[0] + 3 * t * x[1], x[1], 0};
}

Vector rod(Particle& p, double t) {
    const Vector x = p.cell(400, 20);
    return turned({x[0] - 200, x[1] - 10, 0}, pi * t);
}

/// Returns a particle of a bar that rotates about two axes.
Vector tumble(Particle& p, double t) {
    const Vector x = p.cell(80, 10);
    return turned(turned({x[0] - 40, x[1] - 5, x[2] - 5}, pi * t), 0.7 * pi * t, 1, 2);
}

/// Returns a particle of one of eight drops that fall one after another and flatten on the ground.
Vector drops(Particle& p, double t) {
    const std::size_t drop = p.number % 8;
    CounterRandom its(17, drop);
    const double falls = std::max(0.0, t - its.uniform(0, 0.5));
    const double height = its.uniform(20, 80);
    const Vector center{its.uniform(-40, 40), its.uniform(-40, 40), 0};
    const double since = falls - std::sqrt(height / 400);
    const double wide = 1 + 2 * (1 - std::exp(-10 * std::max(0.0, since)));
    const Vector x = p.ball(6.2);
    const double z = std::max(0.0, height - 400 * falls * falls);
    return {center[0] + wide * x[0], center[1] + wide * x[1], z + (6.2 + x[2]) / (wide * wide)};
}

/// Returns a particle of a tank that empties through a nozzle. The jet spreads along a wall.
Vector jet(Particle& p, double t) {
    const double x = 20 * (0.9 * t - p.share);
    const double in_jet = std::clamp(x / 5 + 1, 0.0, 1.0);
    const double place = std::sqrt(p.uniform(0, 1));
    const double angle = p.uniform(0, 2 * pi);
    const double way = 8 * std::max(0.0, x);
    const double beyond = std::max(0.0, way - 80);
    const double radius = 4 * place * (1 + 0.01 * std::min(way, 80.0)) + beyond;
    return {x < 0 ? x : std::min(way, 80 - p.uniform(0, 1) * 16 / (4 + beyond) * (beyond > 0)),
            std::lerp(p.uniform(-10, 10), radius * std::cos(angle), in_jet),
            std::lerp(p.uniform(-10, 10), radius * std::sin(angle), in_jet)};
}

/// Returns a particle of matter that falls into a web, by Zel'dovich's approximation.
Vector web(Particle& p, double t) {
    const Vector start = p.cell(20, 20);
    Vector x = start;
    for (std::uint64_t k = 0; k < 12; ++k) {
        CounterRandom its(23, k);
        Vector wave{};
        double phase = its.uniform(0, 2 * pi);
        for (double& number : wave) number = std::floor(its.uniform(-2, 3)) * 2 * pi / 20;
        for (std::size_t axis = 0; axis < 3; ++axis) phase += wave[axis] * start[axis];
        for (std::size_t axis = 0; axis < 3; ++axis)
            x[axis] += 1.6 * t * wave[axis] * std::sin(phase);
    }
    return x;
}

/// Returns a particle of a block that is wound up: its inner parts rotate faster.
Vector vortex(Particle& p, double t) {
    const Vector cell = p.cell(90, 90);
    const Vector x{cell[0] - 45, cell[1] - 45, 0};
    return turned(x, 4 * pi * t / (1 + (x[0] * x[0] + x[1] * x[1]) / 400));
}

/// Returns a particle of a ball. One half expands, the other half breaks into twelve pieces.
Vector explosion(Particle& p, double t) {
    const double way = 1 - (1 - t) * (1 - t);
    Vector x = p.ball(12.4);
    CounterRandom its(29, p.number / 2 % 12);
    Vector flight{};
    double squares = 0;
    for (double& speed : flight) squares += std::pow(speed = its.uniform(-1, 1), 2);
    const double speed = its.uniform(30, 80) / std::sqrt(squares);
    for (std::size_t axis = 0; axis < 3; ++axis)
        x[axis] = p.number % 2 == 0 ? x[axis] * (1 + 4 * way)
                                    : x[axis] / 2 + flight[axis] * (3 + speed * way);
    return x;
}

/// Returns a particle of a strip that a belt carries around a corner.
Vector conveyor(Particle& p, double t) {
    const Vector x = p.cell(400, 20);
    const double way = x[0] - 400 + 350 * t;
    const double inside = 60 - x[1];
    const double angle = std::clamp(way / 60, 0.0, pi / 2);
    const double after = way - 60 * angle;
    return {inside * std::sin(angle) + after * std::cos(angle),
            60 - inside * std::cos(angle) + after * std::sin(angle), 0};
}

constexpr Flow flows[] = {
    {"dam", 2, 8000, 100, 1, dam},
    {"pour", 3, 8000, 90, 1, pour},
    {"galaxies", 3, 8000, 120, 0.1, galaxies},
    {"front", 2, 8000, 100, 1, front},
    {"shear", 2, 8100, 80, 1, shear},
    {"rod", 2, 8000, 120, 1, rod},
    {"tumble", 3, 8000, 100, 1, tumble},
    {"drops", 3, 8000, 100, 1, drops},
    {"jet", 3, 8000, 100, 1, jet},
    {"web", 3, 8000, 100, 1, web},
    // No option was chosen by means of these two flows.
    {"vortex", 2, 8100, 120, 1, vortex},
    {"explosion", 3, 8000, 80, 1, explosion},
    {"conveyor", 2, 8000, 100, 1, conveyor},
};

}  // namespace

std::vector<double> Flow::positions(std::size_t call) const {
    const double time = static_cast<double>(call) / static_cast<double>(num_calls - 1);
    std::vector<double> x;
    for (std::size_t i = 0; i < num_points; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(num_points);
        Particle particle{i, share, {seed_for(name, 1), i}};
        const Vector at = position(particle, time);
        x.insert(x.end(), at.begin(), at.begin() + dimension);
    }
    return x;
}

std::vector<std::string> flow_names() {
    std::vector<std::string> names;
    for (const Flow& flow : flows) names.emplace_back(flow.name);
    return names;
}

const Flow& make_flow(const std::string& name) {
    const auto* flow = std::ranges::find(flows, name, &Flow::name);
    if (flow == std::end(flows))
        throw Failure("flow '" + name + "' is none of " + joined(flow_names()));
    return *flow;
}

}  // namespace comparisons
