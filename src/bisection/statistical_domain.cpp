#include "bisection/cell_density.hpp"
#include "bisection/patches.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <algorithm>

namespace rrcb {

namespace {

void set_piece(const DensityPiece& piece, double weight, std::size_t axis, Patch& patch) {
    patch.lower[axis] = piece.lower;
    patch.upper[axis] = piece.upper;
    patch.slope[axis] = piece.slope;
    patch.bow[axis] = piece.bow;
    patch.weight = weight;
}

/// Divides the patches from `first` on, which belong to one cell, by a density along an axis. Each
/// patch is replaced by one patch for every piece of the density.
void spread(std::vector<Patch>& patches, std::size_t first, std::size_t axis,
            std::span<const DensityPiece> pieces) {
    const std::size_t last = patches.size();
    for (std::size_t i = first; i < last; ++i) {
        const double weight = patches[i].weight;
        double left = weight;
        for (const DensityPiece& piece : pieces.subspan(1)) {
            Patch& patch = patches.emplace_back(Patch(patches[i]));
            set_piece(piece, weight * piece.share, axis, patch);
            left -= patch.weight;
        }
        set_piece(pieces[0], std::max(0.0, left), axis, patches[i]);
    }
}

/// Returns the weight above which a cell is heavy: more than one cut may divide it. Few cells are
/// heavy, so the additional patches cost little.
double least_heavy_weight(std::span<const double> weights, int dimension) {
    const double many = dimension == 3 ? 64 : 8;
    const auto count = static_cast<double>(weights.size());
    double mean = 0;
    for (const double weight : weights) mean += weight / count;
    return many * mean;
}

/// Appends the patches of a cell as analytic_domain() describes; `box` holds all points.
void append_patches(const CellMoments& cell, double weight, bool is_heavy, const Box& box,
                    StatisticalDomain& domain) {
    const std::size_t first = domain.patches.size();
    domain.patches.push_back({{}, {}, weight, {}, {}});
    for (int a = 0; a < domain.dimension; ++a) {
        const double lower = std::clamp(cell.box.lower[a], box.lower[a], box.upper[a]);
        const double upper = std::clamp(cell.box.upper[a], box.lower[a], box.upper[a]);
        const auto& [mean, deviation] = std::pair(cell.moments.mean[a], cell.moments.deviation[a]);
        if (is_heavy) {
            spread(domain.patches, first, a, entropy_density_of(mean, deviation, lower, upper));
        } else {
            const AxisDensity density = density_of(mean, deviation, lower, upper);
            spread(domain.patches, first, a,
                   std::span(density).first(density[1].share > 0 ? 2 : 1));
        }
    }
}

}  // namespace

std::vector<double> weights_of(std::span<const CellMoments> cells) {
    std::vector<double> weights;
    weights.reserve(cells.size());
    for (const CellMoments& cell : cells) weights.push_back(cell.moments.weight);
    if (std::all_of(weights.begin(), weights.end(), [](double weight) { return weight == 0; })) {
        for (std::size_t i = 0; i < cells.size(); ++i)
            weights[i] = static_cast<double>(cells[i].moments.count);
    }
    return weights;
}

StatisticalDomain analytic_domain(std::span<const CellMoments> cells, int dimension,
                                  const Box& box) {
    check_dimension(dimension, "the domain");
    return locally([&] {
        const std::vector<double> weights = weights_of(cells);
        const double heavy = least_heavy_weight(weights, dimension);
        StatisticalDomain domain{dimension};
        domain.patches.reserve(cells.size());
        for (std::size_t i = 0; i < cells.size(); ++i)
            append_patches(cells[i], weights[i], weights[i] >= heavy, box, domain);
        return domain;
    });
}

}  // namespace rrcb
