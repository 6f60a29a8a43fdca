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
    Numbering(std::vector<Part>&& numbers, std::vector<Part>&& buffer) noexcept;

    bool is_unchanged() const { return numbers_.empty(); }

    Part number_of(Part box) const { return is_unchanged() ? box : numbers_[box]; }
    Part box_of(Part number) const { return is_unchanged() ? number : boxes_[number]; }

    /// Replaces boxes by their numbers.
    void apply(std::span<Part> boxes) const;

    /// Returns the numbers of all boxes, or none if they are unchanged.
    const std::vector<Part>& numbers() const { return numbers_; }

  private:
    std::vector<Part> numbers_;  ///< of all boxes
    std::vector<Part> boxes_;    ///< of all numbers
};

}  // namespace rrcb::zoltan
