#pragma once

#include "collective/handles.hpp"
#include "refinement/histogram.hpp"

#include <mpi.h>

#include <memory>
#include <span>
#include <vector>

namespace rrcb {

/// Histograms of one round of searches. The constructor makes memory, type and reduction, so that
/// no rank can run out of them between two messages.
class Histograms {
  public:
    /// Room for `most` at once. Not collective. Throws Error or std::bad_alloc.
    Histograms(const HistogramLayout& layout, std::size_t most, bool is_root);

    const HistogramLayout& layout() const { return layout_; }
    std::size_t size() const { return size_; }
    void clear() { size_ = 0; }

    /// Adds one, with nothing counted in it.
    std::span<double> add();

    /// Joins the histograms of all ranks, as many on each, at the root: extents and failures by
    /// maximum, weights and counts by sum, samples as samples. Sums are exact (see
    /// CutSearch::quantum), so the bits do not depend on the order in which MPI joins them.
    /// Collective over `comm`.
    void join(int root, MPI_Comm comm);

    /// Number k as joined; at the root only.
    std::span<const double> joined(std::size_t k) const;

    /// True when a rank has failed that took part in the last join; at the root only.
    bool any_failed() const;

    /// Gives all ranks the joined samples of the numbers in `samples` (their order, as many on each
    /// rank; read at the root alone), in place of this round's histograms. Collective over `comm`.
    void broadcast_samples(std::span<const std::size_t> samples, int root, MPI_Comm comm);

    /// Number k of the samples that were broadcast.
    std::span<const double> sample(std::size_t k) const;

  private:
    std::span<double> mine(std::size_t k) const {
        return {mine_.get() + k * layout_.length(), layout_.length()};
    }

    HistogramLayout layout_;
    std::size_t size_ = 0;
    std::unique_ptr<double[]> mine_;
    std::unique_ptr<double[]> joined_;  ///< null elsewhere than at the root
    mpi::ContiguousType type_;
    mpi::Reduction op_;
};

}  // namespace rrcb
