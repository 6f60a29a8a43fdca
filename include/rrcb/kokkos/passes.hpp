#pragma once

#include <rrcb/detail/sample.hpp>
#include <rrcb/kokkos/moments.hpp>
#include <rrcb/kokkos/parts.hpp>

#include <algorithm>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace rrcb {

/// The points of one rank in the memory of an execution space of Kokkos, for balance(PointPasses&).
///
/// Kernels run on `exec` and give the same bits in each run and for each layout. Positions: a view
/// of points by axes, or a std::array of one view for each axis; floats or doubles at any stride.
/// Weights: a view of floats or doubles; empty if every point weighs 1. The class allocates a part
/// for each point; what leaves the device is the results.
template <class ExecutionSpace, class Views, class WeightView>
class KokkosPasses final : public PointPasses {
    using Memory = detail::MemoryOf<Views>;
    using T = detail::ScalarOf<Views>;
    using W = detail::ScalarOf<WeightView>;
    template <class Number>
    static constexpr bool is_real = std::is_same_v<Number, float> || std::is_same_v<Number, double>;

    static_assert(is_real<T> && is_real<W>, "positions and weights must be floats or doubles");
    static_assert(std::is_same_v<Memory, typename WeightView::memory_space>,
                  "weights must be in the memory space of the positions; copy them there with "
                  "Kokkos::create_mirror_view_and_copy()");
    static_assert(Kokkos::SpaceAccessibility<ExecutionSpace, Memory>::accessible,
                  "the execution space cannot read the positions; pass an instance of the one on "
                  "whose device they are");

  public:
    using PartsView = Kokkos::View<Part*, Memory>;

    /// Takes views, also of memory for parts; copies nothing. Not collective, as all of these.
    KokkosPasses(const ExecutionSpace& exec, const Views& x, const WeightView& weights,
                 const PartsView& parts = {})
        : device_(exec),
          views_(x),
          weight_view_(weights),
          x_(detail::positions_of(x)),
          parts_(parts) {
        if (weights.extent(0) == 0) return;
        given_.values = weights.data();
        given_.stride = static_cast<std::int64_t>(weights.stride(0));
    }

    int dimension() const override { return x_.dimension; }
    LocalIndex count() const override { return static_cast<LocalIndex>(x_.count); }
    bool has_weights() const override { return given_.values != nullptr; }
    void use_weights(bool are_used) override { uses_weights_ = are_used; }

    /// Returns the parts of the points, on the device.
    const PartsView& device_parts() const { return parts_; }

    PointSummary summary(bool reads_positions) override {
        check();
        PointSummary summary;
        summary.count = count();
        summary.weight = static_cast<double>(x_.count);
        if (x_.count == 0) return summary;
        summary.lightest = summary.heaviest = 1;
        if (!reads_positions && !weighs()) return summary;
        const detail::Ends ends = find_ends(reads_positions);
        if (weighs()) {
            summary.lightest = ends.lightest;
            summary.heaviest = ends.heaviest;
            summary.weight = detail::total_weight(device_, x_.count, given_);
        }
        detail::check_coordinates(ends.coordinates);
        for (int axis = 0; axis < x_.dimension && reads_positions; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const detail::Position* const first = ends.positions + axis;
            summary.first[a] = std::to_array(first->x);
            summary.last[a] = std::to_array(first[max_dimension].x);
            summary.box.lower[a] = summary.first[a][a];
            summary.box.upper[a] = summary.last[a][a];
        }
        return summary;
    }

    PointSample sample(LocalIndex size) override {
        std::vector<LocalIndex> indices(std::min(size, count()));
        for (std::size_t k = 0; k < indices.size(); ++k)
            indices[k] = count() <= size ? k : detail::sampled(k, count());
        Collected copies;
        detail::copy_points(device_, x_, used_weights(), device_.copy_in(indices), nullptr, copies);
        PointSample sample;
        for (LocalIndex k = 0; k < copies.count(); ++k)
            sample.positions.push_back(copies.position(k));
        sample.weights.assign(copies.weights.begin(), copies.weights.end());
        return sample;
    }

    std::vector<CellMoments> moments(const SupportMesh& mesh) override {
        const detail::Weights<W> weights = known_weights();
        if (!weighs() || heaviest_ > 0) return detail::moments_on(device_, x_, weights, mesh);
        auto cells = detail::moments_on(device_, x_, detail::Weights<W>{}, mesh);
        for (CellMoments& cell : cells) cell.moments.weight = 0;
        return cells;
    }

    PartTotals assign(const Cuts& cuts, bool counts) override {
        check();
        return find_parts({cuts, {}}, true, detail::Opens::none, counts).settled;
    }

    void collect(const Cuts& cuts, std::span<const Bracket> intervals, bool has_parts,
                 Collected& collected) override {
        collected.coordinates.clear();
        collected.weights.clear();
        collected.original.clear();
        take(find_parts({cuts, intervals}, !has_parts, detail::Opens::outside, true), collected);
    }

    std::vector<std::size_t> collect_more(std::span<const Wanted> wanted,
                                          Collected& collected) override {
        const std::size_t num_parts = collected.settled.counts.size();
        detail::PackedCuts given;
        // At first no position.
        given.regions.assign(num_parts, {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {}});
        std::vector<std::size_t> found(num_parts);
        for (std::size_t k = 0; k < wanted.size(); ++k) {
            const Wanted& node = wanted[k];
            detail::Region region;
            region.lower[node.axis] = node.interval.lower;
            region.upper[node.axis] = node.interval.upper;
            std::fill_n(&given.regions[node.first_part], node.num_parts, region);
            std::fill_n(&found[node.first_part], node.num_parts, k);
        }
        std::vector<std::size_t> nodes;
        for (const Part part :
             take(find_parts(given, false, detail::Opens::inside, true), collected))
            nodes.push_back(found[part]);
        return nodes;
    }

    std::vector<Box> boxes(int num_parts) override {
        return detail::boxes_of_parts(device_, x_, known_parts(), num_parts);
    }

    void settle(const Collected& collected, std::span<const Part> parts) override {
        const auto indices = device_.copy_in(collected.original);
        const auto values = device_.copy_in(parts);
        Part* const all = known_parts();
        Kokkos::parallel_for(
            "rrcb::settle", device_.range(parts.size()),
            KOKKOS_LAMBDA(const std::int64_t k) { all[indices(k)] = values(k); });
        device_.fence();
    }

    void renumber(std::span<const Part> numbers) override {
        const auto table = device_.copy_in(numbers);
        Part* const parts = known_parts();
        const bool is_one = numbers.size() == 1;
        Kokkos::parallel_for(
            "rrcb::renumber", device_.range(count()),
            KOKKOS_LAMBDA(const std::int64_t i) { parts[i] = table(is_one ? 0 : parts[i]); });
        device_.fence();
    }

    std::vector<Part> parts() const override { return device_.copy_out(parts_); }

    void set_parts(std::span<const Part> parts) override {
        known_parts();
        Kokkos::deep_copy(device_.exec(), parts_, device_.copy_in(parts));
        device_.fence();
    }

  private:
    struct Assigned {
        std::size_t num_open;
        PartTotals settled;
    };

    void check() const {
        detail::require_kokkos();
        detail::require_on_device(x_.are_even, "coordinate arrays must all have the same length");
        const std::size_t num_weights = weight_view_.extent(0);
        detail::require_on_device(
            num_weights == 0 || num_weights == count(),
            "weights must hold one entry per point, or none for unit weights");
    }

    bool weighs() const { return has_weights() && uses_weights_; }
    detail::Weights<W> used_weights() const { return weighs() ? given_ : detail::Weights<W>{}; }

    /// Returns the weights that count, relative to the heaviest. A fence at first.
    detail::Weights<W> known_weights() {
        if (weighs() && heaviest_ < 0) find_ends(false);
        return used_weights();
    }

    /// Reads the weights, and the positions if asked for. A fence.
    detail::Ends find_ends(bool reads_positions) {
        const detail::Ends ends = detail::find_ends(device_, x_, used_weights(), reads_positions);
        if (weighs()) given_.set_heaviest(heaviest_ = ends.heaviest);
        return ends;
    }

    Part* known_parts() {
        if (parts_.extent(0) != count()) parts_ = device_.template allocate<Part>(count());
        return parts_.data();
    }

    /// Finds parts, unless they are given, marks open points, and counts the others. A fence.
    Assigned find_parts(const detail::PackedCuts& cuts, bool finds, detail::Opens opens,
                        bool counts) {
        const int num_parts = static_cast<int>(cuts.regions.size());
        const detail::Weights<W> weights = known_weights();  // with its fence
        const auto nodes = device_.copy_in(cuts.nodes);
        const auto regions = device_.copy_in(cuts.regions);
        const detail::Assign<T, W> assign{
            x_,        weights, nodes.data(), regions.data(), known_parts(),
            num_parts, finds,   opens,        counts};
        const std::vector<double> bins =
            detail::sum_in_bins(device_, x_.count, assign.num_bins(), std::vector{assign});
        if (bins[assign.bad] > 0) detail::check_coordinates(find_ends(true).coordinates);
        Assigned found{static_cast<std::size_t>(bins[assign.open]), {}};
        if (!counts) return found;
        const auto first = bins.begin() + assign.first;
        found.settled.counts.assign(first, first + num_parts);
        found.settled.weights.assign(bins.end() - num_parts, bins.end());
        if (weighs())
            for (double& weight : found.settled.weights) weight = given_.from_units(weight);
        return found;
    }

    /// Moves open points to the host, behind others; returns their parts. A fence.
    std::vector<Part> take(Assigned&& found, Collected& collected) {
        collected.dimension = x_.dimension;
        collected.settled = std::move(found.settled);
        if (found.num_open == 0) return {};
        const auto indices = detail::list_marked(device_, count(), found.num_open, parts_.data());
        return detail::copy_points(device_, x_, used_weights(), indices, parts_.data(), collected);
    }

    mutable detail::Device<ExecutionSpace, Memory> device_;
    Views views_;
    WeightView weight_view_;
    detail::Positions<T> x_;
    detail::Weights<W> given_{};
    bool uses_weights_ = true;
    double heaviest_ = -1;  ///< weight; -1: not known
    PartsView parts_;
};

}  // namespace rrcb
