#pragma once

#include <rrcb/detail/sample.hpp>
#include <rrcb/experimental/kokkos/moments.hpp>
#include <rrcb/experimental/kokkos/parts.hpp>

#include <span>
#include <utility>

namespace rrcb::detail {

/// Memory of calls with views, which the next call reuses.
template <class MemorySpace>
struct KokkosMemory {
    Kokkos::View<Part*, MemorySpace> parts{};    ///< has at least as many entries as the last call
                                                 ///< had points
    Kokkos::View<char*, MemorySpace> scratch{};  ///< shared by the steps of a call
};

/// The points of one rank in the memory of an execution space of Kokkos, for balance(PointPasses&).
///
/// Kernels run on `exec`. Results are bit-identical in each run and for each layout. Positions are
/// a view of points by axes, or a std::array of one view for each axis, of floats or doubles at any
/// stride. Weights are a view of floats or doubles, which is empty if every point weighs 1. Only
/// results are copied from the device.
template <class ExecutionSpace, class Views, class WeightView>
class KokkosPasses final : public PointPasses {
    using Axes = detail::Axes<Views>;
    using Memory = MemoryOf<Views>;
    using Device = detail::Device<ExecutionSpace, Memory>;
    using T = typename AxisOf<Views>::non_const_value_type;
    using W = typename WeightView::non_const_value_type;

    static_assert(Scalar<T> && Scalar<W>, "positions and weights must be floats or doubles");
    static_assert(std::is_same_v<Memory, typename WeightView::memory_space>,
                  "weights must be in the memory space of the positions; copy them there with "
                  "Kokkos::create_mirror_view_and_copy()");
    static_assert(Kokkos::SpaceAccessibility<ExecutionSpace, Memory>::accessible,
                  "the execution space cannot read the positions; pass an instance of the one on "
                  "whose device they are");
    static_assert(Axes::number <= max_dimension, "positions have 1 to 3 axes");

  public:
    /// Takes views, and memory of an earlier call if it is given. Copies nothing. Not collective,
    /// as all functions of this class.
    KokkosPasses(const ExecutionSpace& exec, const Views& x, const WeightView& weights,
                 const KokkosMemory<Memory>& memory = {})
        : device_(exec, memory.scratch),
          x_(x),
          weight_view_(weights),
          weights_{weights.data(), static_cast<std::int64_t>(weights.stride(0))},
          parts_(memory.parts) {}

    int dimension() const override { return static_cast<int>(Axes::number_of(x_)); }
    LocalIndex count() const override { return Axes::length_of(x_, 0); }
    bool has_weights() const override { return weight_view_.extent(0) > 0; }
    void use_weights(bool are_used) override { uses_weights_ = are_used; }
    std::int64_t most_cells() const override {
        return bins_in_scratch(device_.exec()) / fields_of_cell(dimension(), weighs());
    }

    /// Returns the parts of the points, in the memory of the device.
    auto device_parts() const {
        return Kokkos::subview(parts_, std::pair(std::size_t{0}, count()));
    }
    /// Returns the memory, for use in another call.
    KokkosMemory<Memory> memory() const { return {parts_, device_.memory()}; }

    PointSummary summary(bool reads_positions) override {
        check();
        PointSummary summary;
        summary.count = count();
        summary.weight = static_cast<double>(count());
        if (count() == 0) return summary;
        summary.lightest = summary.heaviest = 1;
        if (!reads_positions && !weighs()) return summary;
        std::vector<LocalIndex> points;
        on_points([&](const auto& x, auto weighs) {
            const auto ends = find_ends<weighs.value>(device_, x, weights_, reads_positions);
            if (ends.faults > 0) reject();
            points.assign(std::begin(ends.points), std::end(ends.points));
            if (!weighs) return;
            summary.lightest = ends.lightest;
            weights_.set_heaviest(summary.heaviest = ends.heaviest);
            const AddWeights<W> rows{weights_};
            const auto sums = sum_in_bins(device_, x.count, 1, rows);
            summary.weight = weights_.from_units(sums[0]);
            if (!std::isfinite(summary.weight)) reject();
        });
        if (!reads_positions) return summary;
        Collected ends;
        copy(device_.copy_in(points), nullptr, ends);
        for (int axis = 0; axis < dimension(); ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            summary.first[a] = ends.position(a);
            summary.last[a] = ends.position(a + points.size() / 2);
            summary.box.lower[a] = summary.first[a][a];
            summary.box.upper[a] = summary.last[a][a];
        }
        return summary;
    }

    PointSample sample(LocalIndex size) override {
        std::vector<LocalIndex> indices(std::min(size, count()));
        for (std::size_t k = 0; k < indices.size(); ++k)
            indices[k] = count() <= size ? k : sampled(k, count());
        Collected copies;
        copy(device_.copy_in(indices), nullptr, copies);
        PointSample sample;
        for (LocalIndex k = 0; k < copies.count(); ++k)
            sample.positions.push_back(copies.position(k));
        sample.weights.assign(copies.weights.begin(), copies.weights.end());
        return sample;
    }

    std::vector<CellMoments> moments(const SupportMesh& mesh) override {
        learn_heaviest();
        const bool is_light = weighs() && !(weights_.heaviest > 0);
        auto cells = on_points(
            [&](const auto& x, auto weighs) {
                return moments_on<weighs.value>(device_, x, weights_, mesh);
            },
            !is_light);
        for (CellMoments& cell : cells)
            if (is_light) cell.moments.weight = 0;
        return cells;
    }

    PartTotals assign(const Cuts& cuts, bool counts) override {
        check();
        PackedCuts packed;
        // The intervals are only needed to open points.
        packed.add(cuts, std::vector<Bracket>(cuts.tree.size()), cuts.num_parts, {});
        Collected none;
        find_parts(packed, true, Opens::none, counts, none);
        return none.settled;
    }

    void collect(const Cuts& cuts, std::span<const Bracket> intervals, bool has_parts,
                 Collected& collected) override {
        collected.coordinates.clear();
        collected.weights.clear();
        collected.original.clear();
        PackedCuts packed;
        packed.add(cuts, intervals, cuts.num_parts, {});
        find_parts(packed, !has_parts, Opens::outside, true, collected);
    }

    std::vector<std::size_t> collect_more(std::span<const Wanted> wanted,
                                          Collected& collected) override {
        const std::size_t num_parts = collected.settled.counts.size();
        PackedCuts given;
        // These regions contain no position; wanted nodes get theirs below.
        given.regions.assign(num_parts, {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {}});
        std::vector<std::size_t> found(num_parts);
        for (std::size_t k = 0; k < wanted.size(); ++k) {
            const Wanted& node = wanted[k];
            Region region;
            region.lower[node.axis] = node.interval.lower;
            region.upper[node.axis] = node.interval.upper;
            std::fill_n(&given.regions[node.first_part], node.num_parts, region);
            std::fill_n(&found[node.first_part], node.num_parts, k);
        }
        std::vector<std::size_t> nodes;
        for (const Part part : find_parts(given, false, Opens::inside, true, collected))
            nodes.push_back(found[part]);
        return nodes;
    }

    std::vector<Box> boxes(int num_parts) override {
        Part* const all = known_parts();
        return on_points(
            [&](const auto& x, auto) { return boxes_of_parts(device_, x, all, num_parts); });
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

    std::vector<Part> parts() const override { return device_.copy_out(device_parts()); }

    void set_parts(std::span<const Part> parts) override {
        known_parts();
        Kokkos::deep_copy(device_.exec(), device_parts(), device_.copy_in(parts));
        device_.fence();
    }

  private:
    void check() const {
        require_kokkos();
        require_on_device(dimension() >= 1 && dimension() <= max_dimension,
                          "positions have 1 to 3 axes, not " + std::to_string(dimension()));
        for (std::size_t axis = 1; axis < Axes::number_of(x_); ++axis)
            require_on_device(Axes::length_of(x_, axis) == count(),
                              "coordinate arrays must all have the same length");
        require_on_device(!has_weights() || weight_view_.extent(0) == count(),
                          "weights must hold one entry per point, or none for unit weights");
    }

    /// Throws the Error of the host if a coordinate or weight is illegal. Copies all points there.
    void reject() {
        const PointSample all = sample(count());
        Points points(std::span(all.positions[0].data(), max_dimension * count()), max_dimension,
                      all.weights);
        points.dimension = dimension();
        summary_of(points);
    }

    bool weighs() const { return has_weights() && uses_weights_; }

    /// Returns call(x, whether weights count) with types by which the compiler knows the dimension
    /// and whether weights count.
    template <int Dimension = static_cast<int>(Axes::number), class Call>
    auto on_points(const Call& call, bool may_weigh = true) const {
        if constexpr (Dimension > 0) {
            using Layout = typename AxisOf<Views>::array_layout;
            Positions<T, Dimension, !std::is_same_v<Layout, Kokkos::LayoutStride>> x;
            x.count = static_cast<std::int64_t>(count());
            for (int a = 0; a < Dimension; ++a) {
                const auto axis = Axes::view_of(x_, a);
                x.values[a] = axis.data();
                x.strides[a] = static_cast<std::int64_t>(axis.stride(0));
            }
            return weighs() && may_weigh ? call(x, std::true_type{}) : call(x, std::false_type{});
        } else {
            if (dimension() == 1) return on_points<1>(call, may_weigh);
            return dimension() == 2 ? on_points<2>(call, may_weigh) : on_points<3>(call, may_weigh);
        }
    }

    /// Reads the weights if the heaviest is not known yet.
    void learn_heaviest() {
        if (weighs() && weights_.heaviest < 0) summary(false);
    }

    Part* known_parts() {
        // Allocates an eighth more after the first call, because the number of points may grow.
        const std::size_t room = parts_.extent(0) > 0 ? count() / 8 : 0;
        if (parts_.extent(0) < count()) parts_ = device_.template allocate<Part>(count() + room);
        return parts_.data();
    }

    /// Finds the parts, unless they are given, and counts their points. Appends open points to
    /// those on the host instead, and returns the parts that they had. Ends with a fence.
    std::vector<Part> find_parts(const PackedCuts& cuts, bool finds, Opens opens, bool counts,
                                 Collected& to) {
        learn_heaviest();  // may fence, so it comes before the copies
        const auto num_parts = static_cast<Part>(cuts.regions.size());
        const auto nodes = device_.copy_in(cuts.nodes);
        const auto regions = device_.copy_in(cuts.regions);
        Part* const parts = known_parts();
        to.dimension = dimension();
        to.settled = {};
        const auto num_open = on_points([&](const auto& x, auto weighs) {
            using Assign = detail::Assign<std::remove_cvref_t<decltype(x)>, W, weighs.value>;
            const Assign assign{x,         weights_, nodes.data(), regions.data(), parts,
                                num_parts, finds,    opens,        counts};
            const auto bins = sum_in_bins(device_, x.count, assign.num_bins(), assign);
            if (bins[assign.bad] > 0) reject();
            for (std::size_t k = assign.fields * assign.first; k < bins.size();
                 k += assign.fields) {
                to.settled.counts.push_back(bins[k]);
                const double weight = bins[k + assign.fields - 1];
                to.settled.weights.push_back(weighs ? weights_.from_units(weight) : weight);
            }
            return static_cast<std::size_t>(bins[assign.fields * assign.open]);
        });
        if (num_open == 0) return {};
        return copy(list_marked(device_, count(), num_open, parts), parts, to);
    }

    /// Appends points to those on the host, see copy_points(). Ends with a fence.
    std::vector<Part> copy(const auto& indices, Part* parts, Collected& to) {
        return on_points([&](const auto& x, auto weighs) {
            return copy_points<weighs.value>(device_, x, weights_, indices, parts, to);
        });
    }

    mutable Device device_;
    Views x_;
    WeightView weight_view_;
    Weights<W> weights_;
    bool uses_weights_ = true;
    Kokkos::View<Part*, Memory> parts_;
};

}  // namespace rrcb::detail
