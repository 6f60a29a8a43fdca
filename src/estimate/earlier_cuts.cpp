#include "estimate/earlier_cuts.hpp"

#include "arithmetic/infinity.hpp"
#include "bisection/bisection.hpp"
#include "cuts/tree.hpp"

#include <span>

namespace rrcb {

namespace {

/// Changes a cut so that parts of size 0 get nothing, and to a plane if the options ask for planes.
void fit(const Options& options, const Descent& at, Cut& cut) {
    const int axis = cut.axis;
    double value = cut.at[axis];
    if (!options.part_sizes.empty()) {
        const std::span sizes(options.part_sizes);
        const double share =
            share_below(sizes.subspan(at.first_part, at.num_parts), at.lower_parts());
        if (share <= 0) value = -infinity;
        if (share >= 1) value = infinity;
    }
    if (options.expert.axes.plain || value != cut.at[axis]) cut.at.fill(-infinity);
    cut.divides = 0;
    cut.at[axis] = value;
}

}  // namespace

Cuts fitted(Cuts cuts, const Options& options) {
    for (std::size_t k = 0; k < cuts.tree.size(); ++k) fit(options, node_at(cuts, k), cuts.tree[k]);
    return cuts;
}

}  // namespace rrcb
