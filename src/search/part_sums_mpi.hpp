#pragma once

#include "collective/participant.hpp"

#include <rrcb/points.hpp>

#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Weights of the parts: those of this rank's points, and their sums over all ranks.
class PartSums {
  public:
    PartSums() = default;

    /// Makes the buffers of add_up(). Not collective. Throws std::bad_alloc.
    explicit PartSums(std::size_t num_parts) : here_(num_parts + 1), sums_(num_parts + 2) {}

    /// Returns the weights of this rank's points in each part, to be written before each add_up().
    std::span<double> here() { return std::span(here_).first(here_.size() - 1); }

    /// Adds them up on every rank; returns the imbalance of the sums.
    ///
    /// Collective: a reduction and a broadcast, which carry failures as well; throws if a rank has
    /// failed. `part_sizes` has one entry per part.
    double add_up(std::span<const double> part_sizes, Participant& self);

    /// Sets weights and sums that were counted elsewhere.
    void set(std::span<const double> here, std::span<const double> sums);

    /// Returns the latest sums, one entry per part.
    std::span<double> sums() { return std::span(sums_).first(sums_.size() - 2); }

    /// Moves the sums out, one entry per part.
    std::vector<double> take();

  private:
    std::vector<double> here_;  ///< the weights, then 1 if this rank failed
    std::vector<double> sums_;  ///< the sums, then the number of ranks that failed, and the
                                ///< imbalance
};

}  // namespace rrcb
