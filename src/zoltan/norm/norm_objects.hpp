#pragma once

#include "zoltan/norm/norm_search.hpp"

#include <rrcb/points.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rrcb::zoltan {

/// One rank's objects, grouped by the nodes of a level of the tree.
class NormObjects {
  public:
    /// Makes room for all that follows. Borrows `points` and `loads`. Throws std::bad_alloc.
    NormObjects(const Points& points, std::span<const Load> loads);

    /// A node's objects: a range of `order`.
    struct Range {
        std::size_t begin = 0;
        std::size_t end = 0;
    };
    Range all() const { return {0, order_.size()}; }

    Load sum(const Range& range) const;

    /// Makes a list of a node's objects for the search across an axis. Returns its length.
    std::size_t list(const Range& range, int axis);

    /// First `length` objects of the list of a node for an axis.
    std::span<const std::uint32_t> listed(const Range& range, int axis, std::size_t length) const;

    KeyRange key_range(std::span<const std::uint32_t> list, int along) const;
    void count(std::span<const std::uint32_t> list, int along, const Bins& bins,
               std::span<Load> slots) const;

    /// Keeps the objects in the chosen slot. Returns their number.
    std::size_t keep(const Range& range, int axis, std::size_t length, int along, const Bins& bins,
                     int slot);

    Load sum(std::span<const std::uint32_t> list) const;

    /// Brings the objects below the cut before the others, both in their order. Returns where the
    /// others begin.
    ///
    /// Objects in `place` share one position. Those of them go below that bring the two sides
    /// nearer. `before` is the load beneath them, with that in the same place on lower ranks.
    std::size_t divide(const Range& range, const Cut& cut);
    std::size_t divide(const Range& range, const Cut& cut, std::span<const std::uint32_t> place,
                       Load before, const Aim& aim);

    void assign(const Range& range, Part part, std::span<Part> parts) const;

  private:
    template <class IsBelow>
    std::size_t separate(const Range& range, IsBelow is_below);

    const Points& points_;
    std::span<const Load> loads_;
    std::vector<std::uint32_t> order_;
    std::vector<std::uint32_t> above_;  ///< scratch
    std::array<std::vector<std::uint32_t>, max_dimension> lists_;
};

}  // namespace rrcb::zoltan
