#pragma once

#include "grid/grid.hpp"
#include "particles/stress.hpp"

#include <mpi.h>
#include <mpm/particles.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mpm {

/// The number of points in a block. Their columns stay in the cache from one kernel to the next.
inline constexpr std::size_t block_size = 512;

/// A run: consecutive points of one block that reach the same nodes.
template <int D>
struct CellRun {
    std::size_t begin, end;
    std::size_t node;      ///< index in the patch of the lowest of their nodes
    Components<D> corner;  ///< position of this node, m
};

/// Calls visit(number of a node in the patch) for each node of a run, along x first.
template <int D, typename Visit>
void visit_run_nodes(const GridPatch<D>& patch, const CellRun<D>& run, Visit visit) {
    // Shape functions with a margin have one more node along each axis.
    const auto width = static_cast<std::size_t>(2 + patch.margin);
    const auto row = static_cast<std::size_t>(patch.nodes.count[0]);
    const std::size_t layer = D == 3 ? row * static_cast<std::size_t>(patch.nodes.count[1]) : 0;
    for (std::size_t k = 0; k < (D == 3 ? width : 1); ++k)
        for (std::size_t j = 0; j < width; ++j)
            for (std::size_t i = 0; i < width; ++i) visit(run.node + k * layer + j * row + i);
}

/// Velocity gradients of one block of points, 1/s. [i][j] is the derivative of component i along j.
template <int D>
using VelocityGradients = std::array<std::array<std::array<double, block_size>, D>, D>;

/// The points of one call of a point kernel: a block, or those of its points that have one
/// material.
template <int D>
struct PointBlock {
    std::size_t begin, end;
    std::size_t block_begin;  ///< first point of the block, to which the gradients belong
    double time;              ///< at the start of the step, s
    double time_step;         ///< s
    VelocityGradients<D>* gradients;

    std::size_t size() const { return end - begin; }
    /// Returns the entries i, j of the points' gradients, from the first point on.
    double* gradient(std::size_t i, std::size_t j) const {
        return (*gradients)[i][j].data() + (begin - block_begin);
    }
};

/// Returns the displacement gradient over the step of point k of a block.
template <int D>
struct StepGradients {
    explicit StepGradients(const PointBlock<D>& block) : time_step(block.time_step) {
        for (std::size_t i = 0; i < D; ++i)
            for (std::size_t j = 0; j < D; ++j) entry[i][j] = block.gradient(i, j);
    }
    DisplacementGradient<D> operator[](std::size_t k) const {
        if constexpr (D == 2)
            return {{{time_step * entry[0][0][k], time_step * entry[0][1][k]},
                     {time_step * entry[1][0][k], time_step * entry[1][1][k]}}};
        else
            return {{{time_step * entry[0][0][k], time_step * entry[0][1][k],
                      time_step * entry[0][2][k]},
                     {time_step * entry[1][0][k], time_step * entry[1][1][k],
                      time_step * entry[1][2][k]},
                     {time_step * entry[2][0][k], time_step * entry[2][1][k],
                      time_step * entry[2][2][k]}}};
    }
    double time_step;
    std::array<std::array<const double*, D>, D> entry;
};

/// The time at the start of a step and its length, s.
struct StepTime {
    double time;
    double time_step;
};

/// Changes the nodes of a patch. Before and after it, shared nodes are bit-identical on all ranks.
template <int D>
using NodeKernel = std::function<void(GridPatch<D>&, const StepTime&)>;

/// Adds further contributions of the points to the sums of a patch. Called after p2g.
template <int D>
using ScatterKernel =
    std::function<void(const Particles&, std::span<const CellRun<D>>, GridPatch<D>&)>;

/// Advances a block of points. Never called for a single point.
template <int D>
using PointKernel = std::function<void(Particles&, const PointBlock<D>&)>;

/// Does collective work at the end of a step.
using StepKernel = std::function<void(const StepTime&, MPI_Comm)>;

template <typename Kernel>
struct Named {
    std::string name;
    Kernel kernel;
};

/// The velocity gradient that determines a point's change of volume.
enum class VolumeChange {
    own,    ///< that at the point
    shared  ///< that at the centre of the run
};

/// The columns that the transfers read and change.
template <int D>
struct TransferColumns {
    MotionColumns motion;
    StressColumns<D> stress;
};

/// The transfers between points and nodes, for one dimension and one shape function.
template <int D>
class Transfers {
  public:
    virtual ~Transfers() = default;

    /// Returns the number of layers of nodes beyond their cells that points reach.
    virtual int margin() const = 0;

    /// Groups consecutive points that reach the same nodes. Runs are long if the points are sorted.
    virtual void find_runs(const Particles& particles, const GridPatch<D>& patch,
                           std::vector<CellRun<D>>& runs) const = 0;

    /// Sorts the points by their nodes. The sort is stable.
    virtual void sort(Particles& particles, const GridPatch<D>& patch) const = 0;

    /// Particles to grid: overwrites the patch with the sums of mass, momentum and internal force.
    virtual void p2g(Particles& particles, const std::vector<CellRun<D>>& runs, VolumeChange change,
                     GridPatch<D>& patch) const = 0;

    /// Grid to particles: moves the points of one block and computes their velocity gradients.
    ///
    /// The block begins with the run `first_run`. Returns the first run of the next block.
    virtual std::size_t g2p(Particles& particles, const GridPatch<D>& patch,
                            const std::vector<CellRun<D>>& runs, std::size_t first_run,
                            VolumeChange change, const PointBlock<D>& block) const = 0;

    /// Adds a column of the points to a field of the nodes, weighted by the shape functions.
    virtual void scatter(const Particles& particles, Column column,
                         const std::vector<CellRun<D>>& runs, const GridPatch<D>& patch,
                         std::vector<double>& field) const = 0;
};

/// Returns the transfers for a shape function and adds the columns they need. `least_weight` is the
/// least weight of a point on any of its nodes along an axis.
template <int D>
std::unique_ptr<Transfers<D>> make_transfers(ShapeFunction shape, double least_weight,
                                             Particles& particles);

}  // namespace mpm
