#pragma once

#include "transfer/transfers.hpp"

#include <mpi.h>

#include <functional>
#include <span>
#include <string>

namespace mpm {

/// The time at the start of a step and its length, s.
struct StepTime {
    double time;
    double time_step;
};

/// Changes the nodes of a patch. Shared nodes hold the same bits on all ranks before and after it.
template <int D>
using NodeKernel = std::function<void(GridPatch<D>&, const StepTime&)>;

/// Adds more contributions of the points to the sums of a patch, after those of p2g.
template <int D>
using ScatterKernel =
    std::function<void(const Particles&, std::span<const CellRun<D>>, GridPatch<D>&)>;

/// Changes the velocity gradients or columns of a block of points by the nodes of its runs.
template <int D>
using GradientKernel = std::function<void(Particles&, const GridPatch<D>&,
                                          std::span<const CellRun<D>>, const PointBlock<D>&)>;

/// Advances a block of points. Never called for a single point.
template <int D>
using PointKernel = std::function<void(Particles&, const PointBlock<D>&)>;

/// Collective work at the end of a step.
using StepKernel = std::function<void(const StepTime&, MPI_Comm)>;

template <typename Kernel>
struct Named {
    std::string name;
    Kernel kernel;
};

}  // namespace mpm
