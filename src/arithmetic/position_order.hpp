#pragma once

#include <rrcb/points.hpp>

#include <span>

namespace rrcb {

/// Returns axis number k of the order of points across a cut: first the axis that the cut crosses,
/// then the others in ascending order.
constexpr std::size_t ordering_axis(int axis, int k) {
    return static_cast<std::size_t>(k == 0 ? axis : k <= axis ? k - 1 : k);
}

/// Compares positions by the axes ordering_axis(axis, k) with k from `first` to `last` - 1.
class PositionOrder {
  public:
    PositionOrder(int axis, int first, int last) {
        for (int k = first; k < last; ++k) axes_[size_++] = ordering_axis(axis, k);
    }

    bool operator()(const Vector& a, const Vector& b) const {
        for (const std::size_t axis : axes())
            if (a[axis] != b[axis]) return a[axis] < b[axis];
        return false;
    }

    std::span<const std::size_t> axes() const { return {axes_.data(), size_}; }

  private:
    std::array<std::size_t, max_dimension> axes_{};
    std::size_t size_ = 0;
};

}  // namespace rrcb
