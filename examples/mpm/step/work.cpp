#include "step/work.hpp"

#include <mpm/simulation.hpp>

#include <cstddef>

namespace mpm {

namespace {

/// Calls visit(number) for each neighbour of a node along the axes.
template <int D, typename Visit>
void visit_neighbours(const NodeRange<D>& nodes, std::size_t node, Visit visit) {
    std::size_t stride = 1;
    std::size_t rest = node;
    for (const int count : nodes.count) {
        const auto length = static_cast<std::size_t>(count);
        if (rest % length > 0) visit(node - stride);
        if (rest % length + 1 < length) visit(node + stride);
        rest /= length;
        stride *= length;
    }
}

/// Assigns each node that no point reaches to the nearest node that a point reaches. Returns the
/// number of nodes assigned to each node, which includes the node itself.
template <int D>
std::vector<double> nodes_given_to(const NodeRange<D>& nodes, std::span<const double> reaching) {
    constexpr std::size_t nobody = static_cast<std::size_t>(-1);
    std::vector<std::size_t> owner(reaching.size(), nobody);
    std::vector<std::size_t> front;
    for (std::size_t n = 0; n < reaching.size(); ++n)
        if (reaching[n] > 0) front.push_back(owner[n] = n);
    std::vector<double> given(reaching.size());
    for (std::size_t k = 0; k < front.size(); ++k) {
        const std::size_t here = owner[front[k]];
        ++given[here];
        visit_neighbours<D>(nodes, front[k], [&](std::size_t n) {
            if (owner[n] != nobody) return;
            owner[n] = here;
            front.push_back(n);
        });
    }
    return given;
}

}  // namespace

template <int D>
std::vector<double> point_columns(const GridPatch<D>& patch, std::span<const CellRun<D>> runs) {
    std::vector<double> reaching(patch.sums.size());
    for (const CellRun<D>& run : runs)
        visit_run_nodes(patch, run, [&](std::size_t n) {
            reaching[n] += static_cast<double>(run.end - run.begin);
        });
    const std::vector<double> given = nodes_given_to<D>(patch.nodes, reaching);
    std::vector<double> rows;
    for (const CellRun<D>& run : runs) {
        double nodes = 0;
        visit_run_nodes(patch, run, [&](std::size_t n) { nodes += given[n] / reaching[n]; });
        const double of_run = 1 / static_cast<double>(run.end - run.begin);
        for (std::size_t p = run.begin; p < run.end; ++p)
            rows.insert(rows.end(), {1, of_run, nodes, 0});
    }
    return rows;
}

template std::vector<double> point_columns<2>(const GridPatch<2>&, std::span<const CellRun<2>>);
template std::vector<double> point_columns<3>(const GridPatch<3>&, std::span<const CellRun<3>>);

}  // namespace mpm
