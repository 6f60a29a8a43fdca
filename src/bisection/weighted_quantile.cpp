#include "bisection/weighted_quantile.hpp"

#include "arithmetic/infinity.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

/// Returns the weight that may be due to round-off. So small a weight must not decide on which side
/// of a gap between clusters a cut is.
double negligible(double weight) {
    return 1e-12 * weight;
}

/// The patches of a domain along one axis.
struct Along {
    const Profile& profile;
    int axis;

    /// Calls visit(patch, lower, upper) for the patches with weight.
    template <class Visit>
    void for_each(Visit&& visit) const {
        for (const Patch& patch : profile.domain().patches)
            if (patch.weight > 0) visit(patch, patch.lower[axis], patch.upper[axis]);
    }
};

/// Narrows the range to two neighbouring ends of patches. The weight below `lower` is less than the
/// target; the weight below `upper` is not.
Profile::Range between_ends(const Along& along, Profile::Range range, double target) {
    std::vector<double> ends;
    const auto is_inside = [&](double end) { return range.lower < end && end < range.upper; };
    along.for_each([&](const Patch&, double lower, double upper) {
        if (is_inside(lower)) ends.push_back(lower);
        if (lower < upper && is_inside(upper)) ends.push_back(upper);
    });
    // Each round removes at least one end, usually half of them.
    while (!ends.empty()) {
        const auto middle = ends.begin() + std::ssize(ends) / 2;
        std::ranges::nth_element(ends, middle);
        const double end = *middle;
        const double below = along.profile.weight_below(along.axis, end);
        (below > target - negligible(target) ? range.upper : range.lower) = end;
        std::erase_if(ends, [&](double other) { return !is_inside(other); });
    }
    return range;
}

/// Returns the middle of the gap between a value and the weight that begins at `next`.
double middle_of_gap(double value, double next) {
    return next == infinity ? value : value / 2 + next / 2;
}

/// Returns a cut in the middle of the gap above a jump, or infinity if there is no weight above.
double after_jump(const Along& along, double jump) {
    double next = infinity;
    along.for_each([&](const Patch&, double lower, double upper) {
        if (upper > jump) next = std::min(next, std::max(lower, jump));
    });
    if (next == infinity) return next;
    return std::max(std::nextafter(jump, infinity), middle_of_gap(jump, next));
}

/// Returns the middle of the gap above `value`, or `value` if there is no gap.
double after_slope(const Along& along, double value) {
    double next = infinity;
    along.for_each([&](const Patch&, double lower, double upper) {
        const bool ends_before = upper < value || (upper == value && lower < upper);
        if (!ends_before) next = std::min(next, std::max(lower, value));
    });
    return middle_of_gap(value, next);
}

/// Share of the patches below a cut.
enum class Below { none, some, all };

Below divide(const Along& along, std::span<const int> axes, double target, Vector& at);

/// Divides the patches whose extent along the axis is 0 at `jump`.
Below divide_jump(const Along& along, double jump, std::span<const int> axes, double target,
                  Vector& at) {
    StatisticalDomain tied{along.profile.domain().dimension};
    along.for_each([&](const Patch& patch, double lower, double upper) {
        if (lower == jump && upper == jump) tied.patches.push_back(patch);
    });
    const Profile profile(tied);
    Below below = target < profile.weight() / 2 ? Below::none : Below::all;
    if (!axes.empty()) below = divide({profile, axes[0]}, axes.subspan(1), target, at);
    if (below != Below::some) at.fill(-infinity);
    at[along.axis] = below == Below::all ? after_jump(along, jump) : jump;
    return below;
}

/// Cuts the patches across their axis, and divides ties along `axes`. All of `at` must be -infinity
/// before.
Below divide(const Along& along, std::span<const int> axes, double target, Vector& at) {
    const auto& [profile, axis] = along;
    const double error = negligible(target);
    double& cut = at[axis];
    const Profile::Range near = profile.range_of(axis, target, error);
    if (std::isfinite(near.value) && profile.grows_at(axis, near, target, error)) {
        cut = near.value;
        return Below::some;
    }
    // The target is reached in the jump at `lower`, or on the slope between `lower` and `upper`.
    // Because of round-off it may also seem to be above the jump although the slope has no weight.
    const Profile::Range range = between_ends(along, near, target);
    const double below = profile.weight_below(axis, range.lower);
    double jump = 0;
    along.for_each([&](const Patch& patch, double lower, double upper) {
        if (lower == range.lower && upper == range.lower) jump += patch.weight;
    });
    const double rest = target - below - jump;
    const double slope = profile.weight_below(axis, range.upper) - below - jump;
    if (target - below < jump) {
        const Below of_jump = divide_jump(along, range.lower, axes, target - below, at);
        if (of_jump == Below::none && below == 0) return Below::none;
    } else if (slope > error && rest > error) {
        // This is enough to bisect from the largest double to the smallest.
        constexpr int most_steps = 2000;
        const Profile::Range inside = profile.range_of(axis, target, error, most_steps, range);
        cut = slope - rest > error ? (std::isfinite(inside.value) ? inside.value : inside.lower)
                                   : after_slope(along, range.upper);
        if (jump > 0) cut = std::max(cut, std::nextafter(range.lower, infinity));
    } else if (slope > error) {
        cut = jump > 0 ? std::nextafter(range.lower, infinity) : range.lower;
    } else {
        cut = after_jump(along, range.lower);
    }
    return cut == infinity ? Below::all : Below::some;
}

}  // namespace

Cut weighted_quantile(const Profile& profile, int axis, double target, bool plain) {
    std::array<int, max_dimension> axes{};
    std::size_t num_axes = 0;
    for (int a = 0; a < profile.domain().dimension && !plain; ++a)
        if (a != axis) axes[num_axes++] = a;
    Cut cut{axis, {}};
    cut.at.fill(-infinity);
    divide({profile, axis}, std::span(axes).first(num_axes), target, cut.at);
    return cut;
}

}  // namespace rrcb
