#pragma once

#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb::zoltan {

/// Numbers that REMAP gives to the boxes. A box is a part as the cuts number it.
class Numbering {
  public:
    /// Gives each part the number of its box.
    Numbering() = default;

    /// Gives each box its entry in `numbers`. `buffer` must have the same length.
    Numbering(std::vector<Part>&& numbers, std::vector<Part>&& buffer) noexcept;

    bool is_unchanged() const { return numbers_.empty(); }

    Part number_of(Part box) const { return is_unchanged() ? box : numbers_[box]; }
    Part box_of(Part number) const { return is_unchanged() ? number : boxes_[number]; }

    /// Replaces boxes by their numbers.
    void apply(std::span<Part> boxes) const;

    /// Returns the numbers of all boxes; empty if they are unchanged.
    const std::vector<Part>& numbers() const { return numbers_; }

  private:
    std::vector<Part> numbers_;  ///< number of each box
    std::vector<Part> boxes_;    ///< box of each number
};

}  // namespace rrcb::zoltan
