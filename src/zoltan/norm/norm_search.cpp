#include "zoltan/norm/norm_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rrcb::zoltan {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Bits of a double below its sign. Negative numbers descend while these bits ascend.
constexpr std::int64_t magnitude = std::numeric_limits<std::int64_t>::max();

double value_of(std::int64_t key) {
    return std::bit_cast<double>(key < 0 ? key ^ magnitude : key);
}

/// Rounds with slots even in value. After these, slots are even in the bits, which end any search.
constexpr int rounds_by_value = 2;

}  // namespace

std::int64_t key_of(double value) {
    const auto bits = std::bit_cast<std::int64_t>(value + 0.0);
    return bits < 0 ? bits ^ magnitude : bits;
}

void KeyRange::add(std::int64_t key) {
    complement_of_smallest = std::max(complement_of_smallest, ~key);
    largest = std::max(largest, key);
}

int Bins::slot_of(double value) const {
    if (by_value) {
        const double slot = (value / 2 - half_lower) * per_half;
        return static_cast<int>(std::min(slot, static_cast<double>(count - 1)));
    }
    const auto from_lower =
        static_cast<std::uint64_t>(key_of(value)) - static_cast<std::uint64_t>(lower_key);
    return static_cast<int>(from_lower >> shift);
}

NormSearch::NormSearch(int axis, int num_axes, const Aim& aim)
    : aim_(aim), num_axes_(num_axes), left_(aim.all) {
    cut_.axis = axis;
    cut_.at.fill(-infinity);
}

int NormSearch::current_axis() const {
    if (tied_ == 0) return cut_.axis;
    return tied_ - 1 < cut_.axis ? tied_ - 1 : tied_;
}

bool NormSearch::narrow(const KeyRange& range) {
    lower_ = ~range.complement_of_smallest;
    upper_ = range.largest;
    if (half_extent_ < 0) half_extent_ = value_of(upper_) / 2 - value_of(lower_) / 2;
    if (lower_ < upper_) return true;
    cut_.at[static_cast<std::size_t>(current_axis())] = value_of(lower_);
    const bool one_object = left_[most_weights] == 1;
    if (one_object || tied_ + 1 == num_axes_) {
        finish(!one_object);
    } else {
        ++tied_;
        rounds_ = 0;
    }
    return false;
}

Bins NormSearch::bins(int most) const {
    Bins bins;
    bins.count = most;
    bins.half_lower = value_of(lower_) / 2;
    bins.per_half = most / (value_of(upper_) / 2 - bins.half_lower);
    bins.by_value = rounds_ < rounds_by_value && std::isfinite(bins.per_half);
    bins.lower_key = lower_;
    const auto width = static_cast<std::uint64_t>(upper_) - static_cast<std::uint64_t>(lower_);
    bins.shift = std::max(
        0, static_cast<int>(std::bit_width(width)) - std::countr_zero(static_cast<unsigned>(most)));
    return bins;
}

int NormSearch::choose(std::span<const Load> slots) {
    const std::size_t slot = find_slot(aim_, slots, base_);
    left_ = slots[slot];
    ++rounds_;
    return static_cast<int>(slot);
}

/// Ends the search with the better of the two cuts beside the objects left.
void NormSearch::finish(bool one_place) {
    done_ = true;
    below_ = base_;
    const Load with_them = base_ + left_;
    one_place_ = one_place && norm_below(aim_, with_them) > norm_above(aim_, with_them);
    if (larger_norm(aim_, with_them) >= larger_norm(aim_, base_)) return;
    below_ = with_them;
    double& last = cut_.at[static_cast<std::size_t>(current_axis())];
    last = std::nextafter(last, infinity);
}

bool goes_below(const Aim& aim, const Load& below, const Load& object) {
    return norm_below(aim, below) < norm_above(aim, below) &&
           larger_norm(aim, below + object) <= larger_norm(aim, below);
}

}  // namespace rrcb::zoltan
