#include "zoltan/norm/norm_objects.hpp"

#include <algorithm>
#include <numeric>

namespace rrcb::zoltan {

NormObjects::NormObjects(const Points& points, std::span<const Load> loads)
    : points_(points), loads_(loads), order_(points.count), above_(points.count) {
    std::iota(order_.begin(), order_.end(), 0U);
    for (std::size_t a = 0; a < static_cast<std::size_t>(points.dimension); ++a)
        lists_[a].resize(points.count);
}

Load NormObjects::sum(const Range& range) const {
    return sum(std::span(order_).subspan(range.begin, range.end - range.begin));
}

Load NormObjects::sum(std::span<const std::uint32_t> list) const {
    Load sum{};
    for (const std::uint32_t i : list) sum = sum + loads_[i];
    return sum;
}

std::size_t NormObjects::list(const Range& range, int axis) {
    std::vector<std::uint32_t>& list = lists_[static_cast<std::size_t>(axis)];
    for (std::size_t k = range.begin; k < range.end; ++k) list[k] = order_[k];
    return range.end - range.begin;
}

std::span<const std::uint32_t> NormObjects::listed(const Range& range, int axis,
                                                   std::size_t length) const {
    return std::span(lists_[static_cast<std::size_t>(axis)]).subspan(range.begin, length);
}

KeyRange NormObjects::key_range(std::span<const std::uint32_t> list, int along) const {
    KeyRange range;
    for (const std::uint32_t i : list) range.add(key_of(points_.coordinate(i, along)));
    return range;
}

void NormObjects::count(std::span<const std::uint32_t> list, int along, const Bins& bins,
                        std::span<Load> slots) const {
    for (const std::uint32_t i : list) {
        Load& slot = slots[static_cast<std::size_t>(bins.slot_of(points_.coordinate(i, along)))];
        slot = slot + loads_[i];
    }
}

std::size_t NormObjects::keep(const Range& range, int axis, std::size_t length, int along,
                              const Bins& bins, int slot) {
    std::uint32_t* list = lists_[static_cast<std::size_t>(axis)].data() + range.begin;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < length; ++k)
        if (bins.slot_of(points_.coordinate(list[k], along)) == slot) list[kept++] = list[k];
    return kept;
}

template <class IsBelow>
std::size_t NormObjects::separate(const Range& range, IsBelow is_below) {
    std::size_t below = range.begin;
    std::size_t num_above = 0;
    for (std::size_t k = range.begin; k < range.end; ++k) {
        const std::uint32_t i = order_[k];
        if (is_below(i)) {
            order_[below++] = i;
        } else {
            above_[num_above++] = i;
        }
    }
    for (std::size_t k = 0; k < num_above; ++k) order_[below + k] = above_[k];
    return below;
}

std::size_t NormObjects::divide(const Range& range, const Cut& cut) {
    return separate(range, [&](std::uint32_t i) {
        return !is_above(cut, points_.position(i), points_.dimension);
    });
}

std::size_t NormObjects::divide(const Range& range, const Cut& cut,
                                std::span<const std::uint32_t> place, Load before, const Aim& aim) {
    // Lists keep the order of the node's objects, so one walk along both suffices.
    auto next = place.begin();
    return separate(range, [&](std::uint32_t i) {
        if (next == place.end() || *next != i)
            return !is_above(cut, points_.position(i), points_.dimension);
        ++next;
        const bool below = goes_below(aim, before, loads_[i]);
        before = before + loads_[i];
        return below;
    });
}

void NormObjects::assign(const Range& range, Part part, std::span<Part> parts) const {
    for (std::size_t k = range.begin; k < range.end; ++k) parts[order_[k]] = part;
}

}  // namespace rrcb::zoltan
