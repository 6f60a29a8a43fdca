#include "cuts/cut_limits.hpp"

#include "arithmetic/infinity.hpp"
#include "options/allowed_axes.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace rrcb {

std::array<AxisLimits, max_dimension> axis_limits(const Options& options) {
    std::array<AxisLimits, max_dimension> axes;
    for (std::size_t a = 0;
         a < std::max(options.expert.axes.min_width.size(), options.expert.axes.grid.size()); ++a)
        axes[a] = {options.expert.axes.min_width.empty() ? 0 : options.expert.axes.min_width[a],
                   options.expert.axes.grid.empty() ? GridLines{} : options.expert.axes.grid[a]};
    return axes;
}

CutLimits::CutLimits(const Options& options, const Box& points, int dimension,
                     std::vector<int> given)
    : axes_(axis_limits(options)),
      region_(points),
      dimension_(dimension),
      allowed_(allowed_axes(options.expert.axes.order, dimension).begin(),
               allowed_axes(options.expert.axes.order, dimension).end()),
      whole_(root_of(static_cast<int>(options.part_sizes.size()), options.expert.tree)),
      packing_(options.part_sizes, options.expert.tree),
      given_(std::move(given)),
      limiting_(options.expert.axes.grid.empty() ? "axes.min_width leaves"
                : options.expert.axes.min_width.empty()
                    ? "axes.grid leaves"
                    : "axes.min_width and axes.grid together leave") {
    for (int a = 0; a < dimension; ++a) {
        if (!axes_[a].has_grid()) continue;
        if (!axes_[a].resolves(std::max(std::abs(points.lower[a]), std::abs(points.upper[a]))))
            reject("axes.grid is finer along axis " + std::to_string(a) +
                   " than doubles resolve at these coordinates; give a larger spacing");
        // A point on a line belongs to the cell above it, so a cut at the last points must be
        // allowed.
        if (options.expert.axes.min_width.empty())
            region_.upper[a] = std::nextafter(points.upper[a], infinity);
    }
}

bool CutLimits::has_room() {
    if (given_.empty()) return packing_.fits(whole_, room_in(region_, packing_.num_parts(whole_)));
    for (int axis = 0; axis < dimension_; ++axis)
        if (!has_room_across(whole_, axis)) return false;
    return true;
}

/// Returns true if, on each way down the tree, the first cut across `axis` has an allowed position.
bool CutLimits::has_room_across(const Descent& at, int axis) {
    if (at.is_part()) return true;
    if (divides(at) && given_[at.node] == axis) return !places(at, region_, axis).empty();
    return has_room_across(at.lower(), axis) && has_room_across(at.upper(), axis);
}

void CutLimits::require_room() {
    if (has_room()) return;
    const int num_parts = packing_.num_parts(whole_);
    const Room room = room_in(region_, num_parts);
    const std::string limited(limiting_);
    if (given_.empty())
        reject(limited + " room for " + std::to_string(most_parts(room, whole_.shape, num_parts)) +
               " parts, but " + std::to_string(num_parts) +
               " are asked for; ask for fewer, or set narrower limits");
    std::string side_by_side;
    for (int axis = 0; axis < dimension_; ++axis)
        side_by_side += (axis == 0 ? "" : " x ") + std::to_string(room[axis]);
    reject(
        limited + " room for " + side_by_side +
        " parts side by side, not enough for the given axes of the cuts; set narrower limits, or "
        "leave the axes free");
}

Room CutLimits::room_in(const Box& region, int most) const {
    Room room{1, 1, 1};
    for (const int a : allowed_)
        room[a] = axes_[a].count_between(region.lower[a], region.upper[a], most);
    return room;
}

/// Returns the position of a cut across `axis` that is nearest to `face` and leaves room for a node
/// between them. `is_behind` means that the cut is above the face.
double CutLimits::nearest_face(const Descent& at, int axis, double face, bool is_behind) const {
    if (at.is_part())
        return is_behind ? across(axis).first_behind(face, 1) : across(axis).last_before(face, 1);
    if (!divides(at)) return nearest_face(with_parts(at), axis, face, is_behind);
    const auto& [near, far] =
        is_behind ? std::pair(at.lower(), at.upper()) : std::pair(at.upper(), at.lower());
    const double between = nearest_face(near, axis, face, is_behind);
    if (axis == given_[at.node]) return nearest_face(far, axis, between, is_behind);
    const double beside = nearest_face(far, axis, face, is_behind);
    return is_behind ? std::max(between, beside) : std::min(between, beside);
}

Places CutLimits::places(const Descent& at, const Box& region, int axis) {
    if (!given_.empty())
        return {nearest_face(at.lower(), axis, region.lower[axis], true),
                nearest_face(at.upper(), axis, region.upper[axis], false)};
    const Room room = room_in(region, packing_.num_parts(at));
    const int below = packing_.least_room(at.lower(), axis, room, room[axis]);
    const int above = packing_.least_room(at.upper(), axis, room, room[axis]);
    if (below + above > room[axis]) return {infinity, -infinity};
    return {axes_[axis].first_behind(region.lower[axis], below),
            axes_[axis].last_before(region.upper[axis], above)};
}

Cut CutLimits::nearest(const Cut& cut, const Places& places) const {
    const double value = cut.at[cut.axis];
    const double place = across(cut.axis).nearest(value, places.first, places.last);
    return place == value ? cut : plane(cut.axis, place);
}

}  // namespace rrcb
