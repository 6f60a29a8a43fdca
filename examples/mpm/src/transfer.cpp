#include <mpm/transfer.hpp>

#include <algorithm>

namespace mpm {

void find_cell_runs(const Particles& particles, const MotionColumns& motion, const GridPatch& patch,
                    std::vector<CellRun>& runs) {
    runs.clear();
    const std::span<const double> x = particles[motion.x], y = particles[motion.y];
    const GridShape& shape = patch.shape;
    int last_i = -1, last_j = -1;
    for (std::size_t p = 0; p < particles.size(); ++p) {
        const int i = cell_of(shape, x[p], 0), j = cell_of(shape, y[p], 1);
        if (i != last_i || j != last_j || p % block_size == 0) {
            if (!runs.empty()) runs.back().end = p;
            runs.push_back(
                {p,
                 p,
                 patch.index(i, j),
                 {shape.lower[0] + i * shape.spacing, shape.lower[1] + j * shape.spacing}});
            last_i = i;
            last_j = j;
        }
    }
    if (!runs.empty()) runs.back().end = particles.size();
}

void sort_by_cell(Particles& particles, const MotionColumns& motion, const GridPatch& patch) {
    const std::span<const double> x = particles[motion.x], y = particles[motion.y];
    std::vector<std::size_t> cells(particles.size());
    std::vector<std::size_t> places(patch.sums.size() + 1);
    for (std::size_t p = 0; p < cells.size(); ++p) {
        cells[p] = patch.index(cell_of(patch.shape, x[p], 0), cell_of(patch.shape, y[p], 1));
        ++places[cells[p] + 1];
    }
    for (std::size_t c = 1; c < places.size(); ++c) places[c] += places[c - 1];
    std::vector<std::size_t> order(cells.size());
    for (std::size_t p = 0; p < cells.size(); ++p) order[places[cells[p]]++] = p;
    particles.reorder(order);
}

}  // namespace mpm
