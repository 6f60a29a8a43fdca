#pragma once

#include <mpm/elastic.hpp>
#include <mpm/grid.hpp>
#include <mpm/particles.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace mpm {

/// Points are advanced in blocks of this size, so that what is between kernels stays in cache.
inline constexpr std::size_t block_size = 512;

/// Consecutive points of one block in the same cell.
struct CellRun {
    std::size_t begin, end;
    std::size_t node;  ///< of the cell's lower left corner, in the patch
    Vector corner;     ///< its position, m
};

/// Velocity gradients of one block of points, 1/s; xy is the derivative of x-velocity along y.
struct VelocityGradients {
    std::array<double, block_size> xx, xy, yx, yy;
};

/// One block of points on its way through the point kernels.
struct PointBlock {
    std::size_t begin, end;
    double time_step;
    VelocityGradients gradients;
};

/// A kernel that advances one block of points.
using PointKernel = std::function<void(Particles&, const PointBlock&)>;

/// Groups the points by cells; runs are long when the points are sorted by cell.
void find_cell_runs(const Particles& particles, const MotionColumns& motion, const GridPatch& patch,
                    std::vector<CellRun>& runs);

/// Orders the points by cell, keeping the order within a cell.
void sort_by_cell(Particles& particles, const MotionColumns& motion, const GridPatch& patch);

/// Particles to grid: overwrites the patch with the sums of mass, momentum and internal force.
void p2g(Particles& particles, const MotionColumns& motion, const StressColumns& stress,
         const std::vector<CellRun>& runs, GridPatch& patch);

/// Grid to particles: moves the points of the runs of one block and reads their velocity gradients.
///
/// Runs from `first_run` on; returns the first run of the next block.
std::size_t g2p(Particles& particles, const MotionColumns& motion, const GridPatch& patch,
                const std::vector<CellRun>& runs, std::size_t first_run, double flip_fraction,
                PointBlock& block);

}  // namespace mpm
