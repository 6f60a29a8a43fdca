#include "bisection/weighted_quantile.hpp"

#include "arithmetic/infinity.hpp"
#include "bisection/slice.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

/// Returns the weight of possible round-off. It must not decide the side of a gap between
/// clusters.
double negligible(double weight) {
    return 1e-12 * weight;
}

/// A patch along the axis.
struct Interval : Slice {
    std::size_t patch;
};

/// Range in which the cumulative weight passes the target, in the end between two neighbouring
/// breakpoints.
struct Crossing {
    double left = -infinity;       ///< weight below `left` is less than the target
    double right = infinity;       ///< weight below `right` is not
    double below = 0;              ///< weight of the intervals ending at or before `left`
    std::vector<Interval> active;  ///< jumps at `left`, and intervals across it
};

/// Moves one end of the crossing to `pivot` and drops the intervals outside.
void narrow(Crossing& crossing, double pivot, double target) {
    double below = crossing.below;
    for (const Interval& interval : crossing.active) below += weight_below(interval, pivot);
    if (below > target - negligible(target)) {
        crossing.right = pivot;
        std::erase_if(crossing.active, [&](const Interval& i) { return i.lower >= pivot; });
        return;
    }
    crossing.left = pivot;
    std::erase_if(crossing.active, [&](const Interval& i) {
        const bool passed = i.upper < pivot || (i.upper == pivot && !i.is_jump());
        if (passed) crossing.below += i.weight;
        return passed;
    });
}

/// The patches with weight of a domain, or some of them, along an axis.
struct Subset {
    const StatisticalDomain& domain;
    std::size_t axis;
    const std::vector<std::size_t>* patches = nullptr;  ///< null: all

    std::size_t size() const { return patches ? patches->size() : domain.patches.size(); }

    /// Calls `visit` with each patch and its number.
    template <class Visit>
    void for_each(Visit&& visit) const {
        for (std::size_t k = 0; k < size(); ++k) {
            const std::size_t p = patches ? (*patches)[k] : k;
            if (domain.patches[p].weight > 0) visit(domain.patches[p], p);
        }
    }

    bool ends_before(const Patch& patch, double value) const {
        const double upper = patch.upper[axis];
        return upper < value || (upper == value && patch.lower[axis] < upper);
    }
};

/// Returns the weight below a value inside the crossing.
double weight_below(const Crossing& crossing, double value) {
    double below = crossing.below;
    for (const Interval& interval : crossing.active) below += weight_below(interval, value);
    return below;
}

bool passes(double below, double target) {
    return below > target - negligible(target);
}

/// Returns the intervals of a range, or of all values if the range does not contain the crossing.
Crossing crossing_in(const Subset& subset, const Profile::Range& range, double target) {
    Crossing crossing{range.lower, range.upper, 0, {}};
    subset.for_each([&](const Patch& patch, std::size_t number) {
        if (subset.ends_before(patch, range.lower)) {
            crossing.below += patch.weight;
        } else if (patch.lower[subset.axis] < range.upper) {
            crossing.active.push_back({slice_of(patch, subset.axis), number});
        }
    });
    const bool is_held =
        (range.lower == -infinity && range.upper == infinity) ||
        (!passes(weight_below(crossing, range.lower), target) &&
         (range.upper == infinity || passes(weight_below(crossing, range.upper), target)));
    if (!is_held) return crossing_in(subset, {}, target);
    return crossing;
}

Crossing find_crossing(const Subset& subset, const Profile::Range& range, double target) {
    Crossing crossing = crossing_in(subset, range, target);
    std::vector<double> breakpoints;
    breakpoints.reserve(2 * crossing.active.size());
    for (const Interval& interval : crossing.active) {
        breakpoints.push_back(interval.lower);
        if (!interval.is_jump()) breakpoints.push_back(interval.upper);
    }
    // The weight below `left` is less than the target, unlike the weight below `right`. The other
    // breakpoints are between; `below` and the active intervals determine the weight below each. A
    // round removes at least one of them, usually half.
    const auto drop_outside = [&] {
        std::erase_if(breakpoints,
                      [&](double b) { return b <= crossing.left || b >= crossing.right; });
    };
    for (drop_outside(); !breakpoints.empty(); drop_outside()) {
        const auto middle = breakpoints.begin() + std::ssize(breakpoints) / 2;
        std::ranges::nth_element(breakpoints, middle);
        narrow(crossing, *middle, target);
    }
    return crossing;
}

/// Returns a cut above a jump: in the middle of the next gap, or infinity if nothing does.
double after_jump(const Subset& subset, double jump) {
    double next = infinity;
    subset.for_each([&](const Patch& patch, std::size_t) {
        if (patch.upper[subset.axis] > jump)
            next = std::min(next, std::max(patch.lower[subset.axis], jump));
    });
    return next == infinity ? next : std::max(std::nextafter(jump, infinity), jump / 2 + next / 2);
}

/// Returns the middle of the gap behind `value`, or `value` if weight begins at once.
double middle_of_gap(const Subset& subset, double value) {
    double next = infinity;
    subset.for_each([&](const Patch& patch, std::size_t) {
        if (!subset.ends_before(patch, value))
            next = std::min(next, std::max(patch.lower[subset.axis], value));
    });
    return next == infinity ? value : value / 2 + next / 2;
}

/// Returns the value inside the crossing with the target below it, by bisection: here Newton's
/// method has failed. `from` is the weight below just behind the left end.
double pass(const Crossing& crossing, double target, double from) {
    if (!(target > from)) return crossing.left;
    double left = crossing.left;
    double right = crossing.right;
    for (;;) {
        const double middle = left / 2 + right / 2;
        const double error = weight_below(crossing, middle) - target;
        const bool is_inside = left < middle && middle < right;
        if (!is_inside || std::abs(error) <= negligible(target)) return middle;
        (error < 0 ? left : right) = middle;
    }
}

/// Share of the patches below a cut.
enum class Below { none, some, all };

Below divide(const Subset& subset, const Profile::Range& range, std::span<const int> axes,
             double target, Vector& at);

/// Divides the patches without extent at the left end of the crossing.
Below divide_jump(const Subset& subset, const Crossing& crossing, std::span<const int> axes,
                  double target, Vector& at) {
    std::vector<std::size_t> tied;
    for (const Interval& interval : crossing.active)
        if (interval.is_jump()) tied.push_back(interval.patch);
    Below below;
    if (axes.empty()) {
        double weight = 0;
        for (const std::size_t p : tied) weight += subset.domain.patches[p].weight;
        below = target < weight / 2 ? Below::none : Below::all;
    } else {
        const auto next = static_cast<std::size_t>(axes[0]);
        below = divide({subset.domain, next, &tied}, {}, axes.subspan(1), target, at);
    }
    if (below != Below::some) at.fill(-infinity);
    at[subset.axis] = below == Below::all ? after_jump(subset, crossing.left) : crossing.left;
    return below;
}

/// Cuts the patches across their axis, and ties along `axes`; all of `at` must be -infinity.
Below divide(const Subset& subset, const Profile::Range& range, std::span<const int> axes,
             double target, Vector& at) {
    const Crossing crossing = find_crossing(subset, range, target);
    double& cut = at[subset.axis];
    // The target is in the jump at `left`, on the slope from there to `right`, or, by round-off,
    // behind a jump with an empty slope.
    double below = crossing.below;
    double jump = 0;
    double slope = 0;
    for (const Interval& interval : crossing.active) {
        const double start = weight_below(interval, crossing.left);
        below += start;
        if (interval.is_jump())
            jump += interval.weight;
        else
            slope += weight_below(interval, crossing.right) - start;
    }
    if (target - below < jump) {
        const Below of_jump = divide_jump(subset, crossing, axes, target - below, at);
        if (of_jump == Below::none && below == 0) return Below::none;
    } else if (slope > 0) {
        const double rest = target - below - jump;
        const double inside = pass(crossing, target, below + jump);
        cut = slope - rest > negligible(target) ? inside : middle_of_gap(subset, crossing.right);
        if (jump > 0) cut = std::max(cut, std::nextafter(crossing.left, infinity));
    } else {
        cut = after_jump(subset, crossing.left);
    }
    return cut == infinity ? Below::all : Below::some;
}

}  // namespace

Cut weighted_quantile(const Profile& profile, double target, bool plain) {
    const StatisticalDomain& domain = profile.domain();
    std::array<int, max_dimension> axes{};
    std::size_t num_axes = 0;
    for (int a = 0; a < domain.dimension && !plain; ++a)
        if (a != profile.axis()) axes[num_axes++] = a;
    Cut cut{profile.axis(), {}};
    cut.at.fill(-infinity);
    const Profile::Range range = profile.range_of(target, negligible(target));
    if (std::isfinite(range.value) && profile.grows_at(range.value, negligible(target))) {
        cut.at[profile.axis()] = range.value;
        return cut;
    }
    divide({domain, static_cast<std::size_t>(profile.axis())}, range,
           std::span(axes).first(num_axes), target, cut.at);
    return cut;
}

}  // namespace rrcb
