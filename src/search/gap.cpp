#include "search/gap.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/position_order.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

void centre(Cut& cut, int num_axes, std::span<const double> gap) {
    for (int k = 0; k < num_axes; ++k) {
        const double above = -gap[std::size_t{2} * k];
        const double below = gap[std::size_t{2} * k + 1];
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
