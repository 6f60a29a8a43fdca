#pragma once

#include <rrcb/detail/sample.hpp>
#include <rrcb/experimental/kokkos/ends.hpp>
#include <rrcb/experimental/kokkos/moments.hpp>
#include <rrcb/experimental/kokkos/parts.hpp>

#include <algorithm>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace rrcb::experimental {

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
    using Memory = detail::MemoryOf<Views>;
    using Device = detail::Device<ExecutionSpace, Memory>;
    using T = detail::ScalarOf<Views>;
    using W = typename WeightView::non_const_value_type;
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

    /// Takes views, and memory of an earlier call if it is given. Copies nothing. Not collective,
    /// as all functions of this class.
    KokkosPasses(const ExecutionSpace& exec, const Views& x, const WeightView& weights,
                 const KokkosMemory<Memory>& memory = {})
        : device_(exec, memory.scratch),
          views_(x),
          weight_view_(weights),
          axes_(detail::axes_of(x)),
          parts_(memory.parts) {
        if (weights.extent(0) == 0) return;
        given_.values = weights.data();
        given_.stride = static_cast<std::int64_t>(weights.stride(0));
    }

    int dimension() const override { return axes_.dimension; }
    LocalIndex count() const override { return static_cast<LocalIndex>(axes_.count); }
    bool has_weights() const override { return given_.values != nullptr; }
    void use_weights(bool are_used) override { uses_weights_ = are_used; }
    std::int64_t most_cells() const override {
        return detail::bins_in_scratch(device_.exec()) /
               detail::fields_of_cell(dimension(), weighs());
    }

    /// Returns the parts of the points, in the memory of the device.
    PartsView device_parts() const {
        return Kokkos::subview(parts_, std::pair(std::size_t{0}, std::size_t{count()}));
    }
    /// Returns the memory, for use in another call.
    KokkosMemory<Memory> memory() const { return {parts_, device_.memory()}; }

    PointSummary summary(bool reads_positions) override {
        check();
        PointSummary summary;
        summary.count = count();
        summary.weight = static_cast<double>(axes_.count);
        if (axes_.count == 0) return summary;
        summary.lightest = summary.heaviest = 1;
        if (!reads_positions && !weighs()) return summary;
        std::vector<LocalIndex> points;
        on_points([&](const auto& x, auto weighs) {
            const auto ends = detail::find_ends<weighs.value>(device_, x, given_, reads_positions);
            if (weighs) {
                if (ends.faults > 0) detail::check_values(device_, x, given_, true);
                summary.lightest = ends.lightest;
                given_.set_heaviest(summary.heaviest = ends.heaviest);
                summary.weight = detail::total_weight(device_, x.count, given_);
            }
            if (ends.faults > 0) detail::check_values(device_, x, given_, false);
            points.assign(std::begin(ends.points), std::end(ends.points));
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
            indices[k] = count() <= size ? k : detail::sampled(k, count());
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
        const bool is_light = weighs() && !(given_.heaviest > 0);
        auto cells = on_points(
            [&](const auto& x, auto weighs) {
                return detail::moments_on<weighs.value>(device_, x, given_, mesh);
            },
            !is_light);
        for (CellMoments& cell : cells)
            if (is_light) cell.moments.weight = 0;
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
        // These regions contain no position; wanted nodes get theirs below.
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
        Part* const all = known_parts();
        return on_points(
            [&](const auto& x, auto) { return detail::boxes_of_parts(device_, x, all, num_parts); },
            false);
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
    struct Assigned {
        std::size_t num_open;
        PartTotals settled;
    };

    void check() const {
        detail::require_kokkos();
        detail::require_on_device(dimension() >= 1 && dimension() <= max_dimension,
                                  "positions have 1 to 3 axes, not " + std::to_string(dimension()));
        detail::require_on_device(axes_.are_even,
                                  "coordinate arrays must all have the same length");
        detail::require_on_device(
            !has_weights() || weight_view_.extent(0) == count(),
            "weights must hold one entry per point, or none for unit weights");
    }

    bool weighs() const { return has_weights() && uses_weights_; }

    /// Returns call(x, whether weights count) with types by which the compiler knows the dimension
    /// and whether weights count.
    template <class Call>
    auto on_points(const Call& call, bool may_weigh = true) const {
        return detail::with_positions<Views>(axes_, [&](const auto& x) {
            return weighs() && may_weigh ? call(x, std::true_type{}) : call(x, std::false_type{});
        });
    }

    /// Reads the weights if the heaviest is not known yet. Ends with a fence if it reads them.
    void learn_heaviest() {
        if (!weighs() || given_.heaviest >= 0) return;
        on_points([&](const auto& x, auto weighs) {
            const auto ends = detail::find_ends<weighs.value>(device_, x, given_, false);
            if (ends.faults > 0) detail::check_values(device_, x, given_, true);
            given_.set_heaviest(ends.heaviest);
        });
    }

    Part* known_parts() {
        // Allocates an eighth more after the first call, because the number of points may grow.
        const std::size_t room = parts_.extent(0) > 0 ? count() / 8 : 0;
        if (parts_.extent(0) < count())
            parts_ = device_.template allocate<Part>(std::size_t{count()} + room);
        return parts_.data();
    }

    /// Finds the parts, unless they are given; marks the open points, and counts the others. Ends
    /// with a fence.
    Assigned find_parts(const detail::PackedCuts& cuts, bool finds, detail::Opens opens,
                        bool counts) {
        learn_heaviest();  // may fence, so it comes before the copies
        const auto num_parts = static_cast<Part>(cuts.regions.size());
        const auto nodes = device_.copy_in(cuts.nodes);
        const auto regions = device_.copy_in(cuts.regions);
        Part* const parts = known_parts();
        return on_points([&](const auto& x, auto weighs) {
            using Assign = detail::Assign<std::remove_cvref_t<decltype(x)>, W, weighs.value>;
            const Assign assign{x,         given_, nodes.data(), regions.data(), parts,
                                num_parts, finds,  opens,        counts};
            const auto bins = detail::sum_in_bins(device_, x.count, assign.num_bins(), assign);
            if (bins[assign.bad] > 0) detail::check_values(device_, x, given_, false);
            Assigned found{static_cast<std::size_t>(bins[assign.fields * assign.open]), {}};
            for (Part part = 0; part < num_parts && counts; ++part) {
                const auto bin = static_cast<std::size_t>(assign.fields * (assign.first + part));
                found.settled.counts.push_back(bins[bin]);
                const double weight = bins[bin + assign.fields - 1];
                found.settled.weights.push_back(weighs ? given_.from_units(weight) : weight);
            }
            return found;
        });
    }

    std::vector<Part> copy(const typename Device::template Lent<LocalIndex>& indices, Part* parts,
                           Collected& to) {
        return on_points([&](const auto& x, auto weighs) {
            return detail::copy_points<weighs.value>(device_, x, given_, indices, parts, to);
        });
    }

    /// Appends the open points to those on the host. Returns the parts that they had. Ends with a
    /// fence.
    std::vector<Part> take(Assigned&& found, Collected& collected) {
        collected.dimension = dimension();
        collected.settled = std::move(found.settled);
        if (found.num_open == 0) return {};
        const auto indices = detail::list_marked(device_, count(), found.num_open, parts_.data());
        return copy(indices, parts_.data(), collected);
    }

    mutable Device device_;
    Views views_;
    WeightView weight_view_;
    detail::Axes<T> axes_;
    detail::Weights<W> given_{};
    bool uses_weights_ = true;
    PartsView parts_;
};

}  // namespace rrcb::experimental
