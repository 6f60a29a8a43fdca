#include "bisection/cell_density.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rrcb {

namespace {

// In this file the coordinate u runs from -1 to 1 across a cell.

/// Mean and variance of u.
struct Spread {
    double mean;
    double variance;
};

/// Part of the interval in u and the density on it; Patch explains slope and bow.
struct UnitPiece {
    double lower;
    double upper;
    double share;
    double slope = 0;
    double bow = 0;
};

/// Returns the quadratic density with this mean and variance on an interval, in units of half its
/// length. The coefficients follow from the squared norms 2/3 and 2/5 of the Legendre polynomials
/// P1 and P2.
UnitPiece quadratic(const Spread& spread) {
    const double square = spread.variance + spread.mean * spread.mean;
    return {-1, 1, 1, 3 * spread.mean, 2.5 * (3 * square - 1)};
}

bool is_nowhere_negative(const UnitPiece& density) {
    const double slope = std::abs(density.slope);
    if (1 - slope + density.bow < 0) return false;
    const bool has_inner_minimum = slope < 3 * density.bow;
    return !has_inner_minimum || 1 - density.bow / 2 - slope * slope / (6 * density.bow) >= 0;
}

/// Returns one or two pieces with a mean (<= 0) and variance that no quadratic density on the cell
/// has.
std::array<UnitPiece, 2> pieces_of(const Spread& spread) {
    const auto [mean, variance] = spread;
    // A parabola with 0 at both ends has the variance half^2 / 5.
    const double half = std::sqrt(5 * variance);
    if (mean - half >= -1)
        return {UnitPiece{mean - half, mean + half, 1, 0, -1}, UnitPiece{0, 0, 0}};
    // A quadratic density on [-1, -1 + 2 w] is 0 at the upper end if, with r = reach,
    // w^2 - 4 r w + 5/2 (r^2 + variance) = 0.
    const double reach = 1 + mean;
    const double root = 1.5 * reach * reach - 2.5 * variance;
    if (root >= 0) {
        const double w = 2 * reach - std::sqrt(root);
        UnitPiece piece = quadratic({reach / w - 1, variance / (w * w)});
        piece.upper = std::min(1.0, 2 * w - 1);
        return {piece, UnitPiece{0, 0, 0}};
    }
    // Two uniform densities meet at the mean: one reaches b below it with the share a / (a + b),
    // the other a above it with the rest. Their variance is a b / 3.
    const double above = 3 * variance / reach;
    if (above <= 1 - mean)
        return {UnitPiece{-1, mean, above / (reach + above)},
                UnitPiece{mean, mean + above, reach / (reach + above)}};
    // Two uniform densities of length 2 (1 - c) at the ends, with centres -c and c, have the mean
    // square c^2 + (1 - c)^2 / 3.
    const double square = std::min(1.0, mean * mean + variance);
    const double c = std::max(-mean, (1 + std::sqrt(std::max(0.0, 12 * square - 3))) / 4);
    const double upper_share = (1 + mean / c) / 2;
    return {UnitPiece{-1, 1 - 2 * c, 1 - upper_share}, UnitPiece{2 * c - 1, 1, upper_share}};
}

UnitPiece mirrored(const UnitPiece& piece) {
    return {-piece.upper, -piece.lower, piece.share, -piece.slope, piece.bow};
}

DensityPiece in_cell(const UnitPiece& piece, double lower, double upper) {
    const double from = std::lerp(lower, upper, piece.lower / 2 + 0.5);
    const double to = std::lerp(lower, upper, piece.upper / 2 + 0.5);
    return {from, std::max(from, to), piece.share, piece.slope, piece.bow};
}

}  // namespace

AxisDensity density_of(double mean, double deviation, double lower, double upper) {
    mean = std::clamp(mean, lower, upper);
    const double below = mean / 2 - lower / 2;
    const double above = upper / 2 - mean / 2;
    const double half = below + above;
    if (!(half > 0 && deviation > 0)) return {DensityPiece{mean, mean, 1}, DensityPiece{}};
    const double u = (below - above) / half;
    const double sigma = deviation / half;
    const double variance = std::min(sigma * sigma, (1 - u) * (1 + u));
    if (!(variance > 0)) return {DensityPiece{mean, mean, 1}, DensityPiece{}};
    const UnitPiece whole = quadratic({u, variance});
    if (is_nowhere_negative(whole))
        return {DensityPiece{lower, upper, 1, whole.slope, whole.bow}, DensityPiece{}};
    const bool is_mirrored = u > 0;
    const auto pieces = pieces_of({-std::abs(u), variance});
    AxisDensity density;
    for (std::size_t k = 0; k < 2; ++k)
        density[k] = in_cell(is_mirrored ? mirrored(pieces[k]) : pieces[k], lower, upper);
    return density;
}

namespace {

constexpr std::size_t num_density_pieces = 6;
// Nodes and weights of Gauss-Legendre quadrature on [-1, 1], exact up to degree 9.
constexpr std::array<double, 5> gauss_nodes{-0.90617984593866399, -0.53846931010568309, 0,
                                            0.53846931010568309, 0.90617984593866399};
constexpr std::array<double, 5> gauss_weights{0.23692688505618909, 0.47862867049936647,
                                              0.56888888888888889, 0.47862867049936647,
                                              0.23692688505618909};
constexpr std::size_t num_abscissas = num_density_pieces * gauss_nodes.size();

double node(std::size_t i) {
    const double piece = static_cast<double>(i / gauss_nodes.size());
    return (2 * piece + 1 + gauss_nodes[i % gauss_nodes.size()]) / num_density_pieces - 1;
}

/// The density exp(b u + c u^2), represented by masses at the nodes whose sum is 1.
struct Tilted {
    double b = 0;
    double c = 0;
    std::array<double, num_abscissas> masses{};
    double log_sum = 0;
    std::array<double, 5> powers{};  ///< means of u^k
};

Tilted tilted(double b, double c) {
    Tilted density{b, c};
    double greatest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < num_abscissas; ++i)
        greatest = std::max(greatest, node(i) * (b + c * node(i)));
    double sum = 0;
    for (std::size_t i = 0; i < num_abscissas; ++i) {
        const double u = node(i);
        density.masses[i] =
            gauss_weights[i % gauss_nodes.size()] * std::exp(u * (b + c * u) - greatest);
        sum += density.masses[i];
    }
    density.log_sum = greatest + std::log(sum);
    for (std::size_t i = 0; i < num_abscissas; ++i) {
        density.masses[i] /= sum;
        double term = density.masses[i];
        for (double& power : density.powers) {
            power += term;
            term *= node(i);
        }
    }
    return density;
}

/// Finds b and c by Newton's method. They minimize the convex function (log sum - b mean - c
/// square), whose gradient is the error of the moments. A step is halved until the function
/// decreases.
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

/// Appends one piece with the moments that the density has at the nodes of this piece.
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
    const double from = static_cast<double>(2 * piece) / num_density_pieces - 1;
    const double to = static_cast<double>(2 * piece + 2) / num_density_pieces - 1;
    const double half = upper / 2 - lower / 2;
    for (DensityPiece part : density_of(at(mean), std::sqrt(variance) * half, at(from), at(to))) {
        part.share *= share;
        if (part.share > 0) pieces.push_back(part);
    }
}

}  // namespace

std::vector<DensityPiece> entropy_density_of(double mean, double deviation, double lower,
                                             double upper) {
    // This is in standard deviations. Almost no weight is farther from the mean.
    constexpr double reach = 4;
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
    for (std::size_t k = 0; k < num_density_pieces; ++k)
        append_piece(k, density, lower, upper, pieces);
    return pieces;
}

}  // namespace rrcb
