#include "bisection/learned_domain.hpp"

#include "bisection/cell_patches.hpp"
#include "bisection/learned_prior.hpp"
#include "bisection/slice.hpp"
#include "bisection/sub_cell_tilt.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rrcb {

namespace {

/// The cells of one mesh, in its order, and the weight of each in the domain.
struct MeshCells {
    const SupportMesh& mesh;
    std::span<const CellMoments> cells;
    std::span<const double> weights;
    double heavy = 0;     ///< weight of a heavy cell, see least_heavy_weight()
    double heaviest = 0;  ///< weight of a point, where the counts are not known

    /// Index of the cell of this number; nothing where it holds no weight.
    std::optional<std::size_t> find(LocalIndex number) const {
        const auto at = std::ranges::lower_bound(cells, number, {}, &CellMoments::cell);
        if (at == cells.end() || at->cell != number) return std::nullopt;
        return static_cast<std::size_t>(at - cells.begin());
    }

    /// Number of points in a cell, or how many there are at least.
    double count(std::size_t cell) const {
        const GlobalCount known = cells[cell].moments.count;
        if (known > 0) return static_cast<double>(known);
        return heaviest > 0 ? weights[cell] / heaviest : 0;
    }
};

/// Moments in units of the cell. They may be rounded ones, which reach a little out of it.
CellSpread spread_in_cell(const CellMoments& cell) {
    constexpr double most = 0.5;
    CellSpread spread;
    for (std::size_t a = 0; a < 2; ++a) {
        const auto [lower, upper] = std::pair(cell.box.lower[a], cell.box.upper[a]);
        const double mean = std::clamp(cell.moments.mean[a], lower, upper);
        spread.mean[a] = fraction_below(lower, mean, upper) - 0.5;
        spread.deviation[a] =
            std::min(most, cell.moments.deviation[a] / 2 / (upper / 2 - lower / 2));
    }
    return spread;
}

CellInputs inputs_of(const CellMoments& cell, double weight, double weight_in_the_middle) {
    // Of the form that neither overflows nor divides 0 by 0.
    CellInputs inputs{1 / (1 + weight_in_the_middle / weight)};
    const CellSpread spread = spread_in_cell(cell);
    std::ranges::copy(spread.mean, inputs.mean);
    std::ranges::copy(spread.deviation, inputs.deviation);
    return inputs;
}

Neighbourhood around(const MeshCells& all, std::size_t middle) {
    Neighbourhood result;
    const auto across = static_cast<std::ptrdiff_t>(all.mesh.cells[0]);
    const auto up = static_cast<std::ptrdiff_t>(all.mesh.cells[1]);
    const auto number = static_cast<std::ptrdiff_t>(all.cells[middle].cell);
    for (std::ptrdiff_t i = 0; i < 3; ++i) {
        for (std::ptrdiff_t j = 0; j < 3; ++j) {
            const std::ptrdiff_t x = number % across + i - 1;
            const std::ptrdiff_t y = number / across + j - 1;
            CellInputs& inputs = result.cells[i][j];
            inputs.is_outside = x < 0 || x >= across || y < 0 || y >= up;
            if (inputs.is_outside) continue;
            const auto at = all.find(static_cast<LocalIndex>(y * across + x));
            if (at && all.weights[*at] > 0)
                inputs = inputs_of(all.cells[*at], all.weights[*at], all.weights[middle]);
        }
    }
    result.count = all.count(middle);
    return result;
}

/// Share of the cell in the middle in the weight of all nine.
double share_of_middle(const Neighbourhood& around) {
    double sum = 0;
    for (const auto& row : around.cells)
        for (const CellInputs& cell : row) sum += cell.ratio / (1 - std::min(cell.ratio, 1 - 1e-9));
    return 1 / sum;
}

/// By how much a point of the shares `p` is likelier to have come from them than from `q`: Kullback
/// and Leibler, On information and sufficiency (1951).
double information(const SubCells& p, const SubCells& q) {
    double sum = 0;
    for (int k = 0; k < p.size(); ++k)
        if (p[k] > 0) sum += p[k] * std::log(p[k] / std::max(q[k], 1e-300));
    return sum;
}

/// Shares of the sub-cells, where the prior is sure of itself.
std::optional<SubCells> learned_shares(const MeshCells& all, std::size_t cell) {
    // Less than this the points of the cell could not tell from chance, and there is nothing to
    // win.
    constexpr double least_information = 16;
    // A lump with next to nothing around: its neighbours tell nothing of it.
    constexpr double largest_share = 0.75;
    constexpr double fewest_points = 16;
    if (!(all.count(cell) >= fewest_points)) return std::nullopt;
    const Neighbourhood neighbourhood = around(all, cell);
    if (share_of_middle(neighbourhood) > largest_share) return std::nullopt;
    const CellSpread spread = spread_in_cell(all.cells[cell]);
    const auto even = tilted(SubCells::Zero(), spread);
    if (!even) return std::nullopt;
    const auto shares = tilted(learned_prior(neighbourhood), spread);
    if (!shares || information(*shares, *even) * neighbourhood.count < least_information)
        return std::nullopt;
    return shares;
}

void append_sub_cells(const CellMoments& cell, double weight, const SubCells& shares,
                      const Box& box, StatisticalDomain& domain) {
    const auto face = [&](std::size_t axis, int k) {
        const double at =
            std::lerp(cell.box.lower[axis], cell.box.upper[axis], static_cast<double>(k) / num_sub);
        return std::clamp(at, box.lower[axis], box.upper[axis]);
    };
    for (int k = 0; k < shares.size(); ++k) {
        const int x = k / num_sub;
        const int y = k % num_sub;
        const double part = weight * shares[k];
        if (part > 0)
            domain.patches.push_back(
                {{face(0, x), face(1, y)}, {face(0, x + 1), face(1, y + 1)}, part, {}, {}});
    }
}

void append_mesh(const MeshCells& all, const Box& box, StatisticalDomain& domain) {
    const bool is_plane = domain.dimension == 2 && all.mesh.cells_per_length[0] > 0 &&
                          all.mesh.cells_per_length[1] > 0;
    for (std::size_t i = 0; i < all.cells.size(); ++i) {
        const double weight = all.weights[i];
        const bool may_learn = is_plane && weight > 0 && weight < all.heavy;
        const auto shares = may_learn ? learned_shares(all, i) : std::nullopt;
        if (shares)
            append_sub_cells(all.cells[i], weight, *shares, box, domain);
        else
            append_patches(all.cells[i], weight, weight >= all.heavy, box, domain);
    }
}

}  // namespace

StatisticalDomain learned_domain(std::span<const CellMoments> cells, const SupportMesh& mesh,
                                 const Box& box) {
    const std::vector<double> weights = weights_of(cells);
    StatisticalDomain domain{mesh.dimension};
    append_mesh({mesh, cells, weights, least_heavy_weight(weights, mesh.dimension)}, box, domain);
    return domain;
}

StatisticalDomain learned_domain(const CellSet& set, int dimension, const Box& box) {
    const std::vector<double> weights = weights_of(set.cells);
    const double heavy = least_heavy_weight(weights, dimension);
    StatisticalDomain domain{dimension};
    std::size_t next = 0;
    const auto append_merged = [&](std::size_t end) {
        for (; next < end; ++next)
            append_patches(set.cells[next], weights[next], weights[next] >= heavy, box, domain);
    };
    for (const MeshBlock& block : set.blocks) {
        append_merged(block.begin);
        const std::size_t count = block.end - block.begin;
        append_mesh({block.mesh, std::span(set.cells).subspan(next, count),
                     std::span(weights).subspan(next, count), heavy, set.heaviest},
                    box, domain);
        next = block.end;
    }
    append_merged(set.cells.size());
    return domain;
}

}  // namespace rrcb
