#pragma once

#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb::zoltan {

/// Numbers by REMAP of the boxes, which are the parts as the cuts number them.
class Numbering {
  public:
    /// A part has the number of its box.
    Numbering() = default;

    /// By the number of each box; `buffer` has as many entries.
    static Numbering of_all(std::vector<Part>&& numbers, std::vector<Part>&& buffer) noexcept;

    /// By the numbers of some boxes, one at least, which ascend.
    static Numbering of_some(std::vector<Part>&& boxes, std::vector<Part>&& numbers) noexcept;

    bool is_unchanged() const { return numbers_.empty(); }

    /// Returns whether the number of every box is known.
    bool is_whole() const { return !is_spread_; }

    /// Returns the number of a box; no_part if it is unknown.
    Part number_of(Part box) const;

    /// Replaces boxes by their numbers. A box keeps its own if that is unknown.
    void apply(std::span<Part> boxes) const;

    /// Returns the box of a part, if all are known.
    Part box_of(Part number) const { return is_unchanged() ? number : boxes_[number]; }

    /// Returns the numbers of all boxes, or of the known ones.
    const std::vector<Part>& numbers() const { return numbers_; }

  private:
    Numbering(std::vector<Part>&& boxes, std::vector<Part>&& numbers, bool is_spread) noexcept;

    std::vector<Part> numbers_;  ///< of all boxes, or of those in `boxes_`
    std::vector<Part> boxes_;    ///< of all numbers, or of those in `numbers_`
    bool is_spread_ = false;     ///< over the ranks
};

}  // namespace rrcb::zoltan
