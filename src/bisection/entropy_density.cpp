#include "bisection/entropy_density.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rrcb {

namespace {

constexpr std::size_t num_pieces = 6;
// Gauss-Legendre, on [-1, 1]; exact to the ninth power.
constexpr std::array<double, 5> gauss_nodes{-0.90617984593866399, -0.53846931010568309, 0,
                                            0.53846931010568309, 0.90617984593866399};
constexpr std::array<double, 5> gauss_weights{0.23692688505618909, 0.47862867049936647,
                                              0.56888888888888889, 0.47862867049936647,
                                              0.23692688505618909};
constexpr std::size_t num_nodes = num_pieces * gauss_nodes.size();

/// Within this file u runs from -1 to 1.
double node(std::size_t i) {
    const double piece = static_cast<double>(i / gauss_nodes.size());
    return (2 * piece + 1 + gauss_nodes[i % gauss_nodes.size()]) / num_pieces - 1;
}

/// exp(b u + c u^2), as the masses at the nodes, which add up to 1.
struct Tilted {
    double b = 0;
    double c = 0;
    std::array<double, num_nodes> masses{};
    double log_sum = 0;
    std::array<double, 5> powers{};  ///< means of u^k
};

Tilted tilted(double b, double c) {
    Tilted density{b, c};
    double greatest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < num_nodes; ++i)
        greatest = std::max(greatest, node(i) * (b + c * node(i)));
    double sum = 0;
    for (std::size_t i = 0; i < num_nodes; ++i) {
        const double u = node(i);
        density.masses[i] =
            gauss_weights[i % gauss_nodes.size()] * std::exp(u * (b + c * u) - greatest);
        sum += density.masses[i];
    }
    density.log_sum = greatest + std::log(sum);
    for (std::size_t i = 0; i < num_nodes; ++i) {
        density.masses[i] /= sum;
        double term = density.masses[i];
        for (double& power : density.powers) {
            power += term;
            term *= node(i);
        }
    }
    return density;
}

/// Newton's method on the convex function log sum - b mean - c square, whose gradient is the error
/// of the moments. Steps are halved until it falls.
bool find_tilt(double mean, double square, Tilted& density) {
    constexpr int most_steps = 40;
    constexpr double enough = 1e-13;
    const auto value = [&](const Tilted& d) { return d.log_sum - d.b * mean - d.c * square; };
    const double variance = square - mean * mean;
    density = tilted(mean / variance, -1 / (2 * variance));
    for (int step = 0; step < most_steps; ++step) {
        const auto& p = density.powers;
        const double off_mean = mean - p[1];
        const double off_square = square - p[2];
        if (std::abs(off_mean) <= enough && std::abs(off_square) <= enough) return true;
        const double h11 = p[2] - p[1] * p[1];
        const double h12 = p[3] - p[1] * p[2];
        const double h22 = p[4] - p[2] * p[2];
        const double determinant = h11 * h22 - h12 * h12;
        if (!(determinant > 0)) return false;
        const double db = (h22 * off_mean - h12 * off_square) / determinant;
        const double dc = (h11 * off_square - h12 * off_mean) / determinant;
        double length = 1;
        Tilted next = tilted(density.b + db, density.c + dc);
        while (!(value(next) <= value(density) + 1e-15) && length > 1e-3) {
            length /= 2;
            next = tilted(density.b + length * db, density.c + length * dc);
        }
        density = next;
    }
    return false;
}

/// Appends one piece of a density, with the moments of its nodes.
void append_piece(std::size_t piece, const Tilted& density, double lower, double upper,
                  std::vector<DensityPiece>& pieces) {
    const std::size_t first = piece * gauss_nodes.size();
    double share = 0;
    double mean = 0;
    for (std::size_t i = first; i < first + gauss_nodes.size(); ++i) {
        share += density.masses[i];
        mean += density.masses[i] * node(i);
    }
    if (!(share > 0)) return;
    mean /= share;
    double variance = 0;
    for (std::size_t i = first; i < first + gauss_nodes.size(); ++i)
        variance += density.masses[i] / share * (node(i) - mean) * (node(i) - mean);
    const auto at = [&](double u) { return std::lerp(lower, upper, u / 2 + 0.5); };
    const double from = static_cast<double>(2 * piece) / num_pieces - 1;
    const double to = static_cast<double>(2 * piece + 2) / num_pieces - 1;
    const double half = upper / 2 - lower / 2;
    for (DensityPiece part : density_of(at(mean), std::sqrt(variance) * half, at(from), at(to))) {
        part.share *= share;
        if (part.share > 0) pieces.push_back(part);
    }
}

}  // namespace

std::vector<DensityPiece> entropy_density_of(double mean, double deviation, double lower,
                                             double upper) {
    constexpr double reach = 4;  // deviations; almost no weight is beyond
    const AxisDensity simple = density_of(mean, deviation, lower, upper);
    std::vector<DensityPiece> pieces(simple.begin(),
                                     simple.begin() + (simple[1].share > 0 ? 2 : 1));
    const bool is_on_all =
        simple[1].share == 0 && simple[0].lower == lower && simple[0].upper == upper;
    if (is_on_all || simple[0].lower == simple[0].upper) return pieces;
    lower = std::max(lower, mean - reach * deviation);
    upper = std::min(upper, mean + reach * deviation);
    const double half = upper / 2 - lower / 2;
    if (!(half > 0)) return pieces;
    const double u = (mean / 2 - lower / 2) / half - (upper / 2 - mean / 2) / half;
    const double sigma = deviation / half;
    Tilted density;
    if (!find_tilt(u, u * u + sigma * sigma, density)) return pieces;
    pieces.clear();
    for (std::size_t k = 0; k < num_pieces; ++k) append_piece(k, density, lower, upper, pieces);
    return pieces;
}

}  // namespace rrcb
