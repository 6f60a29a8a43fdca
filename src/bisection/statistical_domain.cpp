#include "bisection/cell_patches.hpp"
#include "options/validation.hpp"

#include <rrcb/method/statistical_domain.hpp>

namespace rrcb {

StatisticalDomain analytic_domain(std::span<const CellMoments> cells, int dimension,
                                  const Box& box) {
    check_dimension(dimension, "the domain");
    const std::vector<double> weights = weights_of(cells);
    const double heavy = least_heavy_weight(weights, dimension);
    StatisticalDomain domain{dimension};
    domain.patches.reserve(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
        append_patches(cells[i], weights[i], weights[i] >= heavy, box, domain);
    return domain;
}

}  // namespace rrcb
