#pragma once

#include <rrcb/detail/sample.hpp>
#include <rrcb/kokkos/collect.hpp>
#include <rrcb/kokkos/moments.hpp>
#include <rrcb/kokkos/parts.hpp>
#include <rrcb/kokkos/summary.hpp>
#include <rrcb/kokkos/tree.hpp>
#include <rrcb/passes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

namespace detail {

template <class Views>
struct ViewType {
    using type = Views;
};
template <class View, std::size_t N>
struct ViewType<std::array<View, N>> {
    using type = View;
};

}  // namespace detail

/// The points of one rank in the memory of an execution space of Kokkos, for balance(PointPasses&).
///
/// Kernels run on `exec` and give the same bits in each run and for each layout. Positions: a view
/// of points by axes, or a std::array of one view for each axis; floats or doubles at any stride.
/// Weights: a view of floats or doubles; empty if every point weighs 1. The class allocates a part
/// for each point; what leaves the device is the results. Functions throw Error before
/// Kokkos::initialize().
template <class ExecutionSpace, class Views, class WeightView>
class KokkosPasses final : public PointPasses {
    using View = typename detail::ViewType<Views>::type;
    using Memory = typename View::memory_space;
    using T = detail::ScalarOf<View>;
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

    /// Takes views; copies nothing. Not collective, as all of these.
    KokkosPasses(const ExecutionSpace& exec, const Views& x, const WeightView& weights)
        : exec_(exec),
          views_(x),
          weight_view_(weights),
          x_(detail::positions_of(x)),
          given_(detail::weights_of(weights)) {}

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
        const detail::FoundEnds found = find_ends(reads_positions);
        const detail::Ends& ends = found.ends;
        if (weighs()) {
            summary.lightest = ends.lightest;
            summary.heaviest = ends.heaviest;
            summary.weight = detail::total_weight<Memory>(exec_, x_.count, given_);
        }
        detail::check_coordinates(found.of_coordinates);
        if (!reads_positions) return summary;
        for (int a = 0; a < x_.dimension; ++a) {
            const auto axis = static_cast<std::size_t>(a);
            std::copy_n(ends.first[a].x, max_dimension, summary.first[axis].begin());
            std::copy_n(ends.last[a].x, max_dimension, summary.last[axis].begin());
            summary.box.lower[axis] = ends.first[a].x[a];
            summary.box.upper[axis] = ends.last[a].x[a];
        }
        return summary;
    }

    PointSample sample(LocalIndex size) override {
        check();
        std::vector<LocalIndex> indices(std::min(size, count()));
        for (std::size_t k = 0; k < indices.size(); ++k)
            indices[k] = count() <= size ? k : detail::sampled(k, count());
        const auto on_device = detail::copy_in<Memory>(exec_, std::span<const LocalIndex>(indices));
        const detail::Copies copies = copied(on_device.data(), indices.size(), nullptr);
        PointSample sample;
        sample.positions.resize(indices.size());
        for (std::size_t k = 0; k < indices.size(); ++k)
            for (int a = 0; a < x_.dimension; ++a)
                sample.positions[k][static_cast<std::size_t>(a)] =
                    copies.coordinates[k * static_cast<std::size_t>(x_.dimension) +
                                       static_cast<std::size_t>(a)];
        sample.weights.assign(copies.weights.begin(), copies.weights.end());
        return sample;
    }

    std::vector<CellMoments> moments(const SupportMesh& mesh) override {
        check();
        const detail::Weights<W> own = weights();
        if (!weighs() || heaviest_ > 0) return detail::moments_on<Memory>(exec_, x_, own, mesh);
        auto cells = detail::moments_on<Memory>(exec_, x_, detail::Weights<W>{}, mesh);
        for (CellMoments& cell : cells) cell.moments.weight = 0;
        return cells;
    }

    PartTotals assign(const Cuts& cuts, bool counts) override {
        return assign_by(cuts, {}, true, counts).totals;
    }

    void collect(const Cuts& cuts, std::span<const Bracket> intervals, bool has_parts,
                 Collected& collected) override {
        Assigned assigned = assign_by(cuts, intervals, !has_parts, true);
        collected.dimension = x_.dimension;
        collected.settled = std::move(assigned.totals);
        clear(collected);
        append(detail::IsOpen{parts_.data()}, assigned.num_open, false, collected);
    }

    std::vector<std::size_t> collect_more(std::span<const Wanted> wanted,
                                          Collected& collected) override {
        check();
        const std::size_t num_parts = collected.settled.counts.size();
        std::vector<detail::WantedOfPart> of_parts(num_parts);
        for (std::size_t k = 0; k < wanted.size(); ++k)
            std::fill_n(of_parts.begin() + wanted[k].first_part, wanted[k].num_parts,
                        detail::WantedOfPart{wanted[k].interval.lower, wanted[k].interval.upper,
                                             wanted[k].axis, static_cast<std::int32_t>(k)});
        const auto table =
            detail::copy_in<Memory>(exec_, std::span<const detail::WantedOfPart>(of_parts));
        const detail::IsWanted<T> test{x_, parts_.data(), table.data()};
        const std::vector<Part> taken =
            append(test, detail::count_points<Memory>(exec_, x_.count, test), true, collected);
        std::vector<std::size_t> found;
        for (const Part part : taken) {
            found.push_back(static_cast<std::size_t>(of_parts[part].wanted));
            collected.settled.counts[part] -= 1;
        }
        weigh_again(of_parts, collected.settled);
        return found;
    }

    std::vector<Box> boxes(int num_parts) override {
        check();
        return detail::boxes_of_parts<Memory>(exec_, x_, known_parts(), num_parts);
    }

    void settle(const Collected& collected, std::span<const Part> parts) override {
        check();
        const auto indices =
            detail::copy_in<Memory>(exec_, std::span<const LocalIndex>(collected.original));
        const auto from = detail::copy_in<Memory>(exec_, parts);
        Kokkos::parallel_for("rrcb::settle",
                             detail::range(exec_, static_cast<std::int64_t>(parts.size())),
                             detail::SetParts{indices.data(), from.data(), known_parts()});
        exec_.fence();
    }

    void renumber(std::span<const Part> numbers) override {
        check();
        known_parts();
        if (numbers.size() == 1) return Kokkos::deep_copy(exec_, parts_, numbers[0]), exec_.fence();
        const auto table = detail::copy_in<Memory>(exec_, numbers);
        Kokkos::parallel_for("rrcb::renumber", detail::range(exec_, x_.count),
                             detail::Renumber{table.data(), parts_.data()});
        exec_.fence();
    }

    std::vector<Part> parts() const override {
        std::vector<Part> copy(parts_.extent(0));
        detail::copy_out(exec_, parts_, std::span(copy));
        exec_.fence();
        return copy;
    }

    void set_parts(std::span<const Part> parts) override {
        check();
        parts_ = detail::copy_in<Memory>(exec_, parts);
        exec_.fence();
    }

  private:
    struct Assigned {
        PartTotals totals;
        LocalIndex num_open = 0;
    };

    void check() const {
        detail::require_kokkos();
        if (!x_.are_even)
            detail::reject_on_device("coordinate arrays must all have the same length");
        if (weight_view_.extent(0) != 0 && weight_view_.extent(0) != count())
            detail::reject_on_device(
                "weights must hold one entry per point, or none for unit weights");
    }

    bool weighs() const { return has_weights() && uses_weights_; }

    /// Returns the weights that count, relative to the heaviest.
    detail::Weights<W> weights() {
        if (!weighs()) return {};
        if (heaviest_ < 0) find_ends(false);
        return given_;
    }

    /// Reads the weights, and the positions if asked for. A fence.
    detail::FoundEnds find_ends(bool reads_positions) {
        const detail::FoundEnds found = detail::find_ends<Memory>(
            exec_, x_, weighs() ? given_ : detail::Weights<W>{}, reads_positions);
        if (weighs()) given_.set_heaviest(heaviest_ = found.ends.heaviest);
        return found;
    }

    /// Copies points to the host. A fence.
    detail::Copies copied(const LocalIndex* indices, LocalIndex number, Part* parts) const {
        return detail::copy_points<Memory>(exec_, x_, weighs() ? given_ : detail::Weights<W>{},
                                           indices, number, parts);
    }

    Part* known_parts() {
        if (parts_.extent(0) != count()) parts_ = detail::allocate<Part, Memory>(exec_, count());
        return parts_.data();
    }

    /// Finds parts, unless they are given, and counts; those not settled become no_part if there
    /// are intervals. A fence.
    Assigned assign_by(const Cuts& cuts, std::span<const Bracket> intervals, bool finds,
                       bool counts) {
        check();
        const detail::DeviceTree<Memory> tree(exec_, cuts, false);
        const std::vector<detail::SettledBox> bounds =
            intervals.empty() ? std::vector<detail::SettledBox>()
                              : detail::settled_bounds(cuts, intervals);
        const auto bounds_view =
            detail::copy_in<Memory>(exec_, std::span<const detail::SettledBox>(bounds));
        const auto of_points = weights();
        const int num_parts = cuts.num_parts;
        const detail::AssignBody<T, W> body{x_,
                                            of_points,
                                            tree.get(),
                                            bounds.empty() ? nullptr : bounds_view.data(),
                                            known_parts(),
                                            num_parts,
                                            finds,
                                            counts,
                                            nullptr};
        const std::vector<double> bins = detail::assigned<Memory>(exec_, body);
        return counts ? totals_of(bins, num_parts) : Assigned{};
    }

    Assigned totals_of(const std::vector<double>& bins, int num_parts) const {
        Assigned assigned;
        const auto parts = static_cast<std::ptrdiff_t>(num_parts);
        assigned.totals.counts.assign(bins.begin(), bins.begin() + parts);
        assigned.num_open = static_cast<LocalIndex>(bins[static_cast<std::size_t>(num_parts)]);
        assigned.totals.weights = assigned.totals.counts;
        if (weighs())
            for (std::size_t p = 0; p < assigned.totals.weights.size(); ++p)
                assigned.totals.weights[p] =
                    given_.from_units(bins[p + static_cast<std::size_t>(num_parts) + 1]);
        return assigned;
    }

    /// Weighs the points in parts that some were taken from.
    void weigh_again(std::span<const detail::WantedOfPart> of_parts, PartTotals& totals) {
        if (!weighs()) {
            totals.weights = totals.counts;
            return;
        }
        const int num_parts = static_cast<int>(of_parts.size());
        const detail::AssignBody<T, W> body{x_,        weights(), {},   nullptr, parts_.data(),
                                            num_parts, false,     true, nullptr};
        const Assigned now = totals_of(detail::assigned<Memory>(exec_, body), num_parts);
        for (std::size_t p = 0; p < of_parts.size(); ++p)
            if (of_parts[p].lower < of_parts[p].upper) totals.weights[p] = now.totals.weights[p];
    }

    static void clear(Collected& collected) {
        collected.coordinates.clear();
        collected.weights.clear();
        collected.original.clear();
    }

    /// Appends the points that pass a test, `number` of them, in ascending order; if `takes`,
    /// returns their parts, and leaves no_part. A fence.
    template <class Test>
    std::vector<Part> append(const Test& test, LocalIndex number, bool takes,
                             Collected& collected) {
        if (number == 0) return {};
        const auto found = detail::allocate<LocalIndex, Memory>(exec_, number);
        Kokkos::parallel_scan("rrcb::list", detail::range(exec_, x_.count),
                              detail::List<Test>{test, found.data()});
        const LocalIndex before = collected.count();
        collected.original.resize(before + number);
        detail::copy_out(exec_, found, std::span(collected.original).subspan(before));
        detail::Copies copies = copied(found.data(), number, takes ? parts_.data() : nullptr);
        const auto add = [](const auto& from, auto& to) {
            to.insert(to.end(), from.begin(), from.end());
        };
        add(copies.coordinates, collected.coordinates);
        add(copies.weights, collected.weights);
        return std::move(copies.taken);
    }

    ExecutionSpace exec_;
    Views views_;
    WeightView weight_view_;
    detail::Positions<T> x_;
    detail::Weights<W> given_;
    bool uses_weights_ = true;
    double heaviest_ = -1;  ///< weight; -1: not known
    PartsView parts_{};
};

}  // namespace rrcb
