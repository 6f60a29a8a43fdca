#include "search/gap.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/position_order.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

void narrow(const Cut& cut, std::span<const Fragment> fragments, const SortedPoints& points,
            Gap& gap) {
    const int dimension = points.dimension();
    for (const Fragment& fragment : fragments) {
        const bool is_within =
            fragment.box.upper[cut.axis] >= gap[1] && fragment.box.lower[cut.axis] <= -gap[0];
        if (!is_within || is_left_out(fragment, points)) continue;
        for (LocalIndex i = fragment.begin; i < fragment.end; ++i) {
            const Vector x = points.position(i);
            const bool above = is_above(cut, x, dimension);
            for (int k = 0; k < dimension; ++k) {
                const std::size_t axis = ordering_axis(cut.axis, k);
                double& end = gap[2 * k + (above ? 0 : 1)];
                end = std::max(end, above ? -x[axis] : x[axis]);
                if (x[axis] != cut.at[axis]) break;
            }
        }
    }
}

void centre(Cut& cut, int num_axes, std::span<const double> gap) {
    for (int k = 0; k < num_axes; ++k) {
        const double above = -gap[2 * k];
        const double below = gap[2 * k + 1];
        if (below == above) continue;
        const bool is_empty = below == -infinity && above == infinity;
        if (is_empty) return;
        cut.at[ordering_axis(cut.axis, k)] =
            above == infinity ? std::nextafter(below, infinity) : middle_of(below, above);
        while (++k < num_axes) cut.at[ordering_axis(cut.axis, k)] = -infinity;
    }
}

double middle_of(double below, double above) {
    const double middle = below / 2 + above / 2;
    return middle > below ? middle : above;
}

}  // namespace rrcb
