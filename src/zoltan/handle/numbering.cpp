#include "zoltan/handle/numbering.hpp"

#include <rrcb/cuts.hpp>

#include <algorithm>
#include <utility>

namespace rrcb::zoltan {

Numbering::Numbering(std::vector<Part>&& boxes, std::vector<Part>&& numbers,
                     bool is_spread) noexcept
    : numbers_(std::move(numbers)), boxes_(std::move(boxes)), is_spread_(is_spread) {}

Numbering Numbering::of_all(std::vector<Part>&& numbers, std::vector<Part>&& buffer) noexcept {
    for (std::size_t box = 0; box < numbers.size(); ++box)
        buffer[numbers[box]] = static_cast<Part>(box);
    return {std::move(buffer), std::move(numbers), false};
}

Numbering Numbering::of_some(std::vector<Part>&& boxes, std::vector<Part>&& numbers) noexcept {
    return {std::move(boxes), std::move(numbers), true};
}

Part Numbering::number_of(Part box) const {
    if (is_unchanged()) return box;
    if (!is_spread_) return numbers_[box];
    const auto found = std::ranges::lower_bound(boxes_, box);
    if (found == boxes_.end() || *found != box) return no_part;
    return numbers_[found - boxes_.begin()];
}

void Numbering::apply(std::span<Part> boxes) const {
    if (is_whole() && !is_unchanged()) {
        const Part* const numbers = numbers_.data();
        for (Part& box : boxes) box = numbers[box];
        return;
    }
    // A failure elsewhere, of which no rank knows yet, may have lost a number.
    for (Part& box : boxes)
        if (const Part number = number_of(box); number != no_part) box = number;
}

}  // namespace rrcb::zoltan
