#pragma once

#include "cut_search.hpp"
#include "mpi/handles.hpp"

#include <mpi.h>

#include <memory>
#include <span>

namespace rrcb {

/// Histograms of one round of searches. Memory, type and reduction are made before the first
/// round, so that no rank can run out of them between two messages.
class Histograms {
  public:
    /// Room for `most` at once. Not collective. Throws Error or std::bad_alloc.
    Histograms(const HistogramLayout& layout, std::size_t most, bool is_root);

    const HistogramLayout& layout() const { return layout_; }
    std::size_t size() const { return size_; }
    void clear() { size_ = 0; }

    /// One more, with nothing counted in it.
    std::span<double> add();

    /// Brings the histograms of all ranks, as many on each, together at the root: extents and
    /// failures by maximum, weights and counts by sum. Collective over `comm`.
    void join(int root, MPI_Comm comm);

    /// Number k as joined; at the root only.
    std::span<const double> joined(std::size_t k) const;

    /// True when a rank has failed that took part in the last join; at the root only.
    bool any_failed() const;

  private:
    HistogramLayout layout_;
    std::size_t size_ = 0;
    std::unique_ptr<double[]> mine_;
    std::unique_ptr<double[]> joined_;  ///< null elsewhere than at the root
    mpi::ContiguousType type_;
    mpi::Reduction op_;
};

}  // namespace rrcb
