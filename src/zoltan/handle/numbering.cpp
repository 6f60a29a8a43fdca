#include "zoltan/handle/numbering.hpp"

#include <utility>

namespace rrcb::zoltan {

Numbering::Numbering(std::vector<Part>&& numbers, std::vector<Part>&& buffer) noexcept
    : numbers_(std::move(numbers)), boxes_(std::move(buffer)) {
    for (std::size_t box = 0; box < numbers_.size(); ++box)
        boxes_[numbers_[box]] = static_cast<Part>(box);
}

void Numbering::apply(std::span<Part> boxes) const {
    if (is_unchanged()) return;
    const Part* const numbers = numbers_.data();
    for (Part& box : boxes) box = numbers[box];
}

}  // namespace rrcb::zoltan
