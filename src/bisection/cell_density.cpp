#include "bisection/cell_density.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

// Within this file u runs from -1 to 1 across a cell.

/// Mean and variance of u.
struct Spread {
    double mean;
    double variance;
};

/// Part of the interval in u, and the density there, see Patch.
struct Piece {
    double lower;
    double upper;
    double share;
    double slope = 0;
    double bow = 0;
};

/// Returns the quadratic density of a spread on an interval, in units of half its length. The
/// Legendre polynomials P1 and P2 have the squared norms 2/3 and 2/5.
Piece quadratic(const Spread& spread) {
    const double square = spread.variance + spread.mean * spread.mean;
    return {-1, 1, 1, 3 * spread.mean, 2.5 * (3 * square - 1)};
}

bool is_nowhere_negative(const Piece& density) {
    const double slope = std::abs(density.slope);
    if (1 - slope + density.bow < 0) return false;
    const bool has_inner_minimum = slope < 3 * density.bow;
    return !has_inner_minimum || 1 - density.bow / 2 - slope * slope / (6 * density.bow) >= 0;
}

/// Returns the density of a spread with mean <= 0 that no quadratic density on the cell has, as one
/// or two pieces.
std::array<Piece, 2> pieces_of(const Spread& spread) {
    const auto [mean, variance] = spread;
    // A parabola that is 0 at both ends has the variance half^2 / 5.
    const double half = std::sqrt(5 * variance);
    if (mean - half >= -1) return {Piece{mean - half, mean + half, 1, 0, -1}, Piece{0, 0, 0}};
    // On [-1, -1 + 2 w] it is 0 at the upper end for w^2 - 4 r w + 5/2 (r^2 + variance) = 0.
    const double reach = 1 + mean;
    const double root = 1.5 * reach * reach - 2.5 * variance;
    if (root >= 0) {
        const double w = 2 * reach - std::sqrt(root);
        Piece piece = quadratic({reach / w - 1, variance / (w * w)});
        piece.upper = std::min(1.0, 2 * w - 1);
        return {piece, Piece{0, 0, 0}};
    }
    // Two uniform densities that meet at the mean, one reaching b below it with the share
    // a / (a + b), one a above it with the rest, have the variance a b / 3.
    const double above = 3 * variance / reach;
    if (above <= 1 - mean)
        return {Piece{-1, mean, above / (reach + above)},
                Piece{mean, mean + above, reach / (reach + above)}};
    // Two of the length 2 (1 - c) at the ends, about -c and c, have the mean square
    // c^2 + (1 - c)^2 / 3.
    const double square = std::min(1.0, mean * mean + variance);
    const double c = std::max(-mean, (1 + std::sqrt(std::max(0.0, 12 * square - 3))) / 4);
    const double upper_share = (1 + mean / c) / 2;
    return {Piece{-1, 1 - 2 * c, 1 - upper_share}, Piece{2 * c - 1, 1, upper_share}};
}

Piece mirrored(const Piece& piece) {
    return {-piece.upper, -piece.lower, piece.share, -piece.slope, piece.bow};
}

DensityPiece in_cell(const Piece& piece, double lower, double upper) {
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
    const Piece whole = quadratic({u, variance});
    if (is_nowhere_negative(whole))
        return {DensityPiece{lower, upper, 1, whole.slope, whole.bow}, DensityPiece{}};
    const bool is_mirrored = u > 0;
    const auto pieces = pieces_of({-std::abs(u), variance});
    AxisDensity density;
    for (std::size_t k = 0; k < 2; ++k)
        density[k] = in_cell(is_mirrored ? mirrored(pieces[k]) : pieces[k], lower, upper);
    return density;
}

}  // namespace rrcb
