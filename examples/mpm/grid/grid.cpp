#include "grid/grid.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

template <int D>
NodeRange<D> intersection(const NodeRange<D>& a, const NodeRange<D>& b) {
    NodeRange<D> both;
    for (std::size_t axis = 0; axis < D; ++axis) {
        both.begin[axis] = std::max(a.begin[axis], b.begin[axis]);
        both.count[axis] = std::min(a.begin[axis] + a.count[axis], b.begin[axis] + b.count[axis]) -
                           both.begin[axis];
    }
    return both;
}

template <int D>
NodeRange<D> nodes_of(const GridShape& shape, const Box& box, int margin) {
    const Vector grid_upper = shape.upper();
    NodeRange<D> nodes;
    for (std::size_t axis = 0; axis < D; ++axis) {
        const double lower = std::max(box.lower[axis], shape.lower[axis]);
        const double upper = std::min(box.upper[axis], grid_upper[axis]);
        if (!(lower <= upper)) return {};
        const int first = cell_of(shape, lower, axis);
        nodes.begin[axis] = first - margin;
        nodes.count[axis] = cell_of(shape, upper, axis) - first + 2 + 2 * margin;
    }
    return nodes;
}

template <int D>
void resize(GridPatch<D>& patch, const NodeRange<D>& nodes) {
    patch.nodes = nodes;
    std::size_t num_nodes = nodes.empty() ? 0 : 1;
    for (const int count : nodes.count) num_nodes *= static_cast<std::size_t>(std::max(count, 0));
    patch.sums.resize(num_nodes);
    patch.motion.resize(num_nodes);
    for (std::vector<double>& field : patch.fields) field.resize(num_nodes);
}

template <int D>
double move_nodes(GridPatch<D>& patch, double time_step, double lightest_point) {
    double fastest = 0;  // square of the largest speed
    for (std::size_t n = 0; n < patch.sums.size(); ++n) {
        const NodeSums<D>& node = patch.sums[n];
        NodeMotion<D>& motion = patch.motion[n];
        motion = {};
        if (!(node.mass > 0)) continue;
        const double share = std::min(node.mass / lightest_point, 1.0);
        double square = 0;
        for (std::size_t a = 0; a < D; ++a) {
            motion.velocity_change[a] = time_step * node.force[a] / node.mass;
            motion.velocity[a] = node.momentum[a] / node.mass + motion.velocity_change[a];
            square += motion.velocity[a] * motion.velocity[a];
        }
        fastest = std::max(fastest, share * share * square);
    }
    return std::sqrt(fastest);
}

template NodeRange<2> intersection<2>(const NodeRange<2>&, const NodeRange<2>&);
template NodeRange<3> intersection<3>(const NodeRange<3>&, const NodeRange<3>&);
template NodeRange<2> nodes_of<2>(const GridShape&, const Box&, int);
template NodeRange<3> nodes_of<3>(const GridShape&, const Box&, int);
template void resize<2>(GridPatch<2>&, const NodeRange<2>&);
template void resize<3>(GridPatch<3>&, const NodeRange<3>&);
template double move_nodes<2>(GridPatch<2>&, double, double);
template double move_nodes<3>(GridPatch<3>&, double, double);

}  // namespace mpm
