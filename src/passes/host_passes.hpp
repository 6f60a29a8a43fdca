#pragma once

#include "passes/assignment.hpp"

#include <rrcb/detail/passes.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Passes over arrays on the host, which are borrowed. The memory for the parts can be reused.
class HostPasses final : public PointPasses {
  public:
    explicit HostPasses(const Points& points, std::vector<Part> memory = {});

    int dimension() const override { return points_.dimension; }
    LocalIndex count() const override { return points_.count; }
    bool has_weights() const override { return !given_weights_.empty(); }
    void use_weights(bool are_used) override;
    PointSummary summary(bool reads_positions) override;
    PointSample sample(LocalIndex size) override;
    std::vector<CellMoments> moments(const SupportMesh& mesh) override;
    PartTotals assign(const Cuts& cuts, bool counts) override;
    void collect(const Cuts& cuts, std::span<const Bracket> intervals, bool has_parts,
                 Collected& collected) override;
    std::vector<std::size_t> collect_more(std::span<const Wanted> wanted,
                                          Collected& collected) override;
    std::vector<Box> boxes(int num_parts) override;
    void settle(const Collected& collected, std::span<const Part> parts) override;
    void renumber(std::span<const Part> numbers) override;
    std::vector<Part> parts() const override { return parts_; }
    void set_parts(std::span<const Part> parts) override;

    /// Returns the parts, one for each point after the first summary().
    std::span<Part> parts_here() { return parts_; }
    /// Moves the parts out.
    std::vector<Part> take_parts() { return std::move(parts_); }

  private:
    Points points_;
    std::span<const double> given_weights_;
    std::vector<Part> parts_;
};

}  // namespace rrcb
