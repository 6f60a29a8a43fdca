#include "bisection/weighted_quantile.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Weight that round-off may leave on the wrong side; it must not decide on which side of a gap
/// between clusters a cut falls.
double negligible(double weight) {
    return 1e-12 * weight;
}

/// Extent of a patch along one axis.
struct Interval {
    double lower;
    double upper;
    double weight;
    std::size_t patch;

    bool is_jump() const { return lower == upper; }
};

/// Range in which the cumulative weight passes the target, in the end between two neighbouring
/// breakpoints.
struct Crossing {
    double left = -infinity;       ///< weight below `left` is less than the target
    double right = infinity;       ///< weight below `right` is not
    double below = 0;              ///< weight of the intervals that end at or before `left`
    std::vector<Interval> active;  ///< jumps at `left`, and intervals that span it
};

double weight_below(const Interval& interval, double value) {
    if (interval.upper < value || (interval.upper == value && !interval.is_jump()))
        return interval.weight;
    if (interval.lower >= value) return 0;
    return interval.weight * fraction_below(interval.lower, value, interval.upper);
}

/// A breakpoint near the median of those left: the median of a few, evenly picked.
double pivot_of(std::span<const double> breakpoints) {
    constexpr std::size_t most = 63;
    std::array<double, most> sample;
    const std::size_t size = std::min(most, breakpoints.size());
    for (std::size_t k = 0; k < size; ++k) sample[k] = breakpoints[k * breakpoints.size() / size];
    const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(size / 2);
    std::nth_element(sample.begin(), middle, sample.begin() + static_cast<std::ptrdiff_t>(size));
    return *middle;
}

/// Moves one end of the crossing to `pivot` and drops what then lies outside.
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

Crossing find_crossing(std::vector<Interval> intervals, double target) {
    Crossing crossing;
    crossing.active = std::move(intervals);
    std::vector<double> breakpoints;
    for (const Interval& interval : crossing.active) {
        breakpoints.push_back(interval.lower);
        if (!interval.is_jump()) breakpoints.push_back(interval.upper);
    }
    // The weight below `left` is less than the target, that below `right` is not. `below` and the
    // active intervals tell the weight below any value between, where all breakpoints left lie.
    // Each round takes one of them at least, half of them as a rule.
    while (!breakpoints.empty()) {
        narrow(crossing, pivot_of(breakpoints), target);
        std::erase_if(breakpoints,
                      [&](double b) { return b <= crossing.left || b >= crossing.right; });
    }
    return crossing;
}

/// Value with the jump at the left end of the crossing below it, and as little else as possible.
double after_jump(const Crossing& crossing) {
    const bool spanned = std::any_of(crossing.active.begin(), crossing.active.end(),
                                     [](const Interval& interval) { return !interval.is_jump(); });
    const double next = std::nextafter(crossing.left, infinity);
    if (spanned || crossing.right == infinity) return spanned ? next : infinity;
    return std::max(next, crossing.left / 2 + crossing.right / 2);
}

/// Middle of the gap that begins at `value`, or `value` where weight begins at once.
double middle_of_gap(std::span<const Interval> intervals, double value) {
    double next = infinity;
    for (const Interval& interval : intervals) {
        if (interval.upper < value || (interval.upper == value && !interval.is_jump())) continue;
        next = std::min(next, std::max(interval.lower, value));
    }
    return next == infinity ? value : value / 2 + next / 2;
}

/// Share of the patches that lies below a cut.
enum class Below { none, some, all };

std::vector<Interval> intervals_of(const StatisticalDomain& domain,
                                   std::span<const std::size_t> patches, std::size_t axis) {
    std::vector<Interval> intervals;
    intervals.reserve(patches.size());
    for (const std::size_t p : patches) {
        const Patch& patch = domain.patches[p];
        intervals.push_back({patch.lower[axis], patch.upper[axis], patch.weight, p});
    }
    return intervals;
}

Below divide(const StatisticalDomain& domain, std::span<const std::size_t> patches,
             std::span<const int> axes, double target, Vector& at);

/// Divides the patches that have no extent and lie at the left end of the crossing.
Below divide_jump(const StatisticalDomain& domain, const Crossing& crossing,
                  std::span<const int> axes, double target, Vector& at) {
    std::vector<std::size_t> tied;
    for (const Interval& interval : crossing.active)
        if (interval.is_jump()) tied.push_back(interval.patch);
    const Below below = divide(domain, tied, axes.subspan(1), target, at);
    const auto axis = static_cast<std::size_t>(axes[0]);
    if (below != Below::some) at.fill(-infinity);
    at[axis] = below == Below::all ? after_jump(crossing) : crossing.left;
    return below;
}

/// Cuts `patches` across axes[0], ties along the axes after it; `at` comes in at -infinity.
Below divide(const StatisticalDomain& domain, std::span<const std::size_t> patches,
             std::span<const int> axes, double target, Vector& at) {
    if (axes.empty()) {
        double weight = 0;
        for (const std::size_t p : patches) weight += domain.patches[p].weight;
        return target < weight / 2 ? Below::none : Below::all;
    }
    const auto axis = static_cast<std::size_t>(axes[0]);
    const std::vector<Interval> intervals = intervals_of(domain, patches, axis);
    const Crossing crossing = find_crossing(intervals, target);
    // The target lies in the jump at `left`, on the slope from there to `right`, or, by round-off,
    // behind a jump with nothing on the slope.
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
        const Below of_jump = divide_jump(domain, crossing, axes, target - below, at);
        if (of_jump == Below::none && below == 0) return Below::none;
    } else if (slope > 0) {
        const double rest = target - below - jump;
        const double inside = std::lerp(crossing.left, crossing.right, rest / slope);
        at[axis] =
            slope - rest > negligible(target) ? inside : middle_of_gap(intervals, crossing.right);
        if (jump > 0) at[axis] = std::max(at[axis], std::nextafter(crossing.left, infinity));
    } else {
        at[axis] = after_jump(crossing);
    }
    return at[axis] == infinity ? Below::all : Below::some;
}

}  // namespace

double fraction_below(double lower, double value, double upper) {
    const double extent = upper - lower;
    if (std::isinf(extent)) return (value / 2 - lower / 2) / (upper / 2 - lower / 2);
    return (value - lower) / extent;
}

Cut weighted_quantile(const StatisticalDomain& domain, int axis, double target, bool plain) {
    std::vector<int> axes{axis};
    for (int a = 0; a < domain.dimension && !plain; ++a)
        if (a != axis) axes.push_back(a);
    std::vector<std::size_t> patches;
    for (std::size_t p = 0; p < domain.patches.size(); ++p)
        if (domain.patches[p].weight > 0) patches.push_back(p);
    Cut cut{axis, {}};
    cut.at.fill(-infinity);
    divide(domain, patches, axes, target, cut.at);
    return cut;
}

}  // namespace rrcb
