#include "transfer/transfers.hpp"

#include "transfer/g2p.hpp"
#include "transfer/scatter.hpp"

namespace mpm {

namespace {

/// The transfers for one dimension and one shape function.
template <int D, class Shape>
class TransfersOf final : public Transfers<D> {
  public:
    TransfersOf(double least_weight, Particles& particles) : shape_(least_weight) {
        columns_.motion = add_motion_columns(particles, D);
        columns_.stress = add_stress_columns<D>(particles);
    }

    int margin() const override { return Shape::margin; }

    void find_runs(const Particles& particles, const GridPatch<D>& patch,
                   std::vector<CellRun<D>>& runs) const override {
        runs.clear();
        const auto at = positions(particles);
        for (std::size_t begin = 0; begin < particles.size(); begin += block_size) {
            const std::size_t end = std::min(begin + block_size, particles.size());
            const FirstNodes first = first_nodes(patch, at, begin, end);
            for (std::size_t p = begin; p < end; ++p)
                if (p == begin || starts_run(first, p - begin))
                    runs.push_back(run_from(patch, first, p, p - begin));
        }
        // A run ends where the next one begins. Runs are split at the ends of blocks.
        for (std::size_t r = 0; r + 1 < runs.size(); ++r) runs[r].end = runs[r + 1].begin;
        if (!runs.empty()) runs.back().end = particles.size();
    }

    void sort(Particles& particles, const GridPatch<D>& patch) const override {
        const auto at = positions(particles);
        std::vector<std::size_t> cells(particles.size());
        std::vector<std::size_t> places(patch.sums.size() + 1);
        for (std::size_t p = 0; p < cells.size(); ++p) {
            cells[p] = patch.index(first_node(patch, at, p));
            ++places[cells[p] + 1];
        }
        // This is a counting sort: places[c] is the next free index of cell c.
        for (std::size_t c = 1; c < places.size(); ++c) places[c] += places[c - 1];
        std::vector<std::size_t> order(cells.size());
        for (std::size_t p = 0; p < cells.size(); ++p) order[places[cells[p]]++] = p;
        particles.reorder(order);
    }

    void p2g(Particles& particles, const std::vector<CellRun<D>>& runs, VolumeChange change,
             GridPatch<D>& patch) const override {
        const auto transfer = change == VolumeChange::own
                                  ? points_to_grid<D, Shape, VolumeChange::own>
                                  : points_to_grid<D, Shape, VolumeChange::shared>;
        transfer(particles, columns_, shape_, runs, patch);
    }

    std::size_t g2p(Particles& particles, const GridPatch<D>& patch,
                    const std::vector<CellRun<D>>& runs, std::size_t first_run, VolumeChange change,
                    const PointBlock<D>& block) const override {
        const auto transfer = change == VolumeChange::own
                                  ? grid_to_points<D, Shape, VolumeChange::own>
                                  : grid_to_points<D, Shape, VolumeChange::shared>;
        return transfer(particles, columns_, shape_, patch, runs, first_run, block);
    }

    void scatter(const Particles& particles, Column column, const std::vector<CellRun<D>>& runs,
                 const GridPatch<D>& patch, std::vector<double>& field) const override {
        scatter_column<D>(positions(particles), particles[column], shape_, runs, patch,
                          field.data());
    }

  private:
    std::array<const double*, D> positions(const Particles& particles) const {
        std::array<const double*, D> at;
        for (std::size_t a = 0; a < D; ++a) at[a] = particles[columns_.motion.position[a]].data();
        return at;
    }

    /// The lowest nodes of the points of a block, one array per axis.
    using FirstNodes = std::array<std::array<int, block_size>, D>;

    FirstNodes first_nodes(const GridPatch<D>& patch, const std::array<const double*, D>& at,
                           std::size_t begin, std::size_t end) const {
        FirstNodes first;
        const GridShape shape = patch.shape;
        for (std::size_t a = 0; a < D; ++a)
            for (std::size_t k = 0; k < end - begin; ++k)
                first[a][k] = shape_.first_node(shape, at[a][begin + k], a);
        return first;
    }

    static bool starts_run(const FirstNodes& first, std::size_t k) {
        for (std::size_t a = 0; a < D; ++a)
            if (first[a][k] != first[a][k - 1]) return true;
        return false;
    }

    static CellRun<D> run_from(const GridPatch<D>& patch, const FirstNodes& first, std::size_t p,
                               std::size_t k) {
        std::array<int, D> node;
        for (std::size_t a = 0; a < D; ++a) node[a] = first[a][k];
        CellRun<D> run{p, p, patch.index(node), {}};
        for (std::size_t a = 0; a < D; ++a)
            run.corner[a] = patch.shape.lower[a] + node[a] * patch.shape.spacing;
        return run;
    }

    std::array<int, D> first_node(const GridPatch<D>& patch, const std::array<const double*, D>& at,
                                  std::size_t p) const {
        std::array<int, D> first;
        for (std::size_t a = 0; a < D; ++a) first[a] = shape_.first_node(patch.shape, at[a][p], a);
        return first;
    }

    Shape shape_;
    TransferColumns<D> columns_;
};

}  // namespace

template <int D>
std::unique_ptr<Transfers<D>> make_transfers(ShapeFunction shape, double least_weight,
                                             Particles& particles) {
    if (shape == ShapeFunction::linear)
        return std::make_unique<TransfersOf<D, LinearShape>>(least_weight, particles);
    return std::make_unique<TransfersOf<D, QuadraticShape>>(least_weight, particles);
}

template std::unique_ptr<Transfers<2>> make_transfers<2>(ShapeFunction, double, Particles&);
template std::unique_ptr<Transfers<3>> make_transfers<3>(ShapeFunction, double, Particles&);

}  // namespace mpm
