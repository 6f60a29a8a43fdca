#pragma once

#include <rrcb/detail/passes.hpp>

namespace rrcb {

/// The caller's passes, with checks of the lengths of everything that they return.
///
/// If a length is wrong, throws Error whose text names the function, the length that it returned,
/// and the right length.
class CheckedPasses final : public PointPasses {
  public:
    /// Borrows the caller's passes.
    explicit CheckedPasses(PointPasses& given) : given_(given) {}

    int dimension() const override { return given_.dimension(); }
    LocalIndex count() const override { return given_.count(); }
    bool has_weights() const override { return given_.has_weights(); }
    void use_weights(bool are_used) override;
    PointSummary summary(bool reads_positions) override;
    PointSample sample(LocalIndex size) override;
    std::vector<CellMoments> moments(const SupportMesh& mesh) override;
    PartTotals assign(const Cuts& cuts, bool counts) override;
    std::unique_ptr<OpenPoints> open(const Cuts& cuts, std::span<const Bracket> intervals,
                                     bool has_parts) override;
    void collect(const Cuts& cuts, std::span<const Bracket> intervals, bool has_parts,
                 Collected& collected) override;
    std::vector<std::size_t> collect_more(std::span<const Wanted> wanted,
                                          Collected& collected) override;
    std::vector<Box> boxes(int num_parts) override;
    void settle(const Collected& collected, std::span<const Part> parts) override {
        given_.settle(collected, parts);
    }
    void renumber(std::span<const Part> numbers) override { given_.renumber(numbers); }
    std::vector<Part> parts() const override;
    void set_parts(std::span<const Part> parts) override { given_.set_parts(parts); }
    std::int64_t most_cells() const override { return given_.most_cells(); }

  private:
    PointPasses& given_;
    bool are_weights_used_ = true;
    PointSummary summary_{};  ///< with the weights
};

}  // namespace rrcb
