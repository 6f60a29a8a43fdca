#include "bisection/weighted_quantile.hpp"

#include "bisection/slice.hpp"

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

/// Weight of one of the patches along the axis.
struct Interval : Slice {
    std::size_t patch;
};

/// Range in which the cumulative weight passes the target, in the end between two neighbouring
/// breakpoints.
struct Crossing {
    double left = -infinity;       ///< weight below `left` is less than the target
    double right = infinity;       ///< weight below `right` is not
    double below = 0;              ///< weight of the intervals that end at or before `left`
    std::vector<Interval> active;  ///< jumps at `left`, and intervals that span it
};

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

/// Drops most of many intervals in a few passes: those away from where a histogram of their middles
/// passes the target.
void narrow_by_histogram(Crossing& crossing, double target) {
    constexpr std::size_t num_bins = 128;
    constexpr std::size_t few = 256;
    if (crossing.active.size() < few) return;
    double lower = infinity;
    double upper = -infinity;
    for (const Interval& interval : crossing.active) {
        lower = std::min(lower, interval.lower);
        upper = std::max(upper, interval.upper);
    }
    const double bins_per_length = num_bins / (upper / 2 - lower / 2) / 2;
    if (!(bins_per_length > 0 && std::isfinite(bins_per_length))) return;
    std::array<double, num_bins> weights{};
    for (const Interval& interval : crossing.active) {
        const double middle = interval.lower / 2 + interval.upper / 2;
        const double bin = (middle / 2 - lower / 2) * bins_per_length * 2;
        weights[std::min(num_bins - 1, static_cast<std::size_t>(bin))] += interval.weight;
    }
    double below = 0;
    std::size_t bin = 0;
    while (bin + 1 < num_bins && below + weights[bin] < target) below += weights[bin++];
    for (const std::size_t edge : {std::max<std::size_t>(bin, 1) - 1, bin + 2})
        if (edge > 0 && edge < num_bins)
            narrow(crossing, std::lerp(lower, upper, static_cast<double>(edge) / num_bins), target);
}

Crossing find_crossing(std::vector<Interval> intervals, double target) {
    Crossing crossing;
    crossing.active = std::move(intervals);
    narrow_by_histogram(crossing, target);
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

/// Weight of the crossing below a value inside it.
double weight_below(const Crossing& crossing, double value) {
    double below = crossing.below;
    for (const Interval& interval : crossing.active) below += weight_below(interval, value);
    return below;
}

/// Value inside the crossing with the target below it, by the Illinois variant of false position
/// (Dowell, Jarratt: A modified regula falsi method, 1971): at once where the weight is spread
/// evenly. `from` is the weight below right behind the left end, `to` that below the right one.
double pass(const Crossing& crossing, double target, double from, double to) {
    constexpr int most_steps = 64;
    double left = crossing.left;
    double right = crossing.right;
    double short_of = target - from;
    double beyond = to - target;
    if (!(short_of > 0)) return left;
    double value = std::lerp(left, right, short_of / (short_of + beyond));
    // The value sought lies between left and right; both differences are above 0.
    int side = 0;
    for (int step = 0; step < most_steps; ++step) {
        const double error = weight_below(crossing, value) - target;
        if (std::abs(error) <= negligible(to)) break;
        const bool is_left = error < 0;
        (is_left ? left : right) = value;
        (is_left ? short_of : beyond) = std::abs(error);
        if (side == (is_left ? -1 : 1)) (is_left ? beyond : short_of) /= 2;
        side = is_left ? -1 : 1;
        double next = std::lerp(left, right, short_of / (short_of + beyond));
        if (!(next > left && next < right)) next = left / 2 + right / 2;
        if (!(next > left && next < right)) break;
        value = next;
    }
    return value;
}

/// Share of the patches that lies below a cut.
enum class Below { none, some, all };

std::vector<Interval> intervals_of(const StatisticalDomain& domain,
                                   std::span<const std::size_t> patches, std::size_t axis) {
    std::vector<Interval> intervals;
    intervals.reserve(patches.size());
    for (const std::size_t p : patches) {
        intervals.push_back({slice_of(domain.patches[p], axis), p});
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
        const double inside = pass(crossing, target, below + jump, below + jump + slope);
        at[axis] =
            slope - rest > negligible(target) ? inside : middle_of_gap(intervals, crossing.right);
        if (jump > 0) at[axis] = std::max(at[axis], std::nextafter(crossing.left, infinity));
    } else {
        at[axis] = after_jump(crossing);
    }
    return at[axis] == infinity ? Below::all : Below::some;
}

}  // namespace

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
