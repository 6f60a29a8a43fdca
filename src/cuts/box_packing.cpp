#include "cuts/box_packing.hpp"

#include "arithmetic/least_number.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace rrcb {

namespace {

/// Returns how many times a room along one axis can be halved.
int halvings(int room) {
    return std::bit_width(static_cast<unsigned>(room)) - 1;
}

}  // namespace

BoxPacking::BoxPacking(std::span<const double> sizes, const TreeShape& shape)
    : shapes_{{}, {empty, empty, 1, 0}}, shape_of_node_(sizes.size() - 1) {
    shape_of_part_.reserve(sizes.size());
    add_node(sizes, root_of(static_cast<int>(sizes.size()), shape));
}

std::size_t BoxPacking::add_node(std::span<const double> sizes, const Descent& at) {
    if (at.is_part()) return shape_of_part_.emplace_back(sizes[at.first_part] > 0 ? single : empty);
    const std::size_t lower = add_node(sizes, at.lower());
    const std::size_t upper = add_node(sizes, at.upper());
    return shape_of_node_[at.node] = shape_with(lower, upper);
}

std::size_t BoxPacking::shape_with(std::size_t lower, std::size_t upper) {
    if (lower == empty) return upper;
    if (upper == empty) return lower;
    const auto [at, is_new] = numbers_.try_emplace({lower, upper}, shapes_.size());
    if (is_new)
        shapes_.push_back({lower, upper, shapes_[lower].num_parts + shapes_[upper].num_parts,
                           1 + std::max(shapes_[lower].depth, shapes_[upper].depth)});
    return at->second;
}

std::size_t BoxPacking::shape_of(const Descent& at) const {
    return at.is_part() ? shape_of_part_[at.first_part] : shape_of_node_[at.node];
}

bool BoxPacking::fits(std::size_t shape, const Room& room) {
    // Computing the least length along the axis with the most room needs the fewest look-ups.
    Room sorted = room;
    std::ranges::sort(sorted);
    if (sorted[2] >= shapes_[shape].num_parts) return true;
    return least_length(shape, sorted[0], sorted[1]) <= sorted[2];
}

int BoxPacking::least_room(const Descent& at, int axis, Room room, int most) {
    const std::size_t shape = shape_of(at);
    return least_number(1, most, [&](int length) {
        room[axis] = length;
        return fits(shape, room);
    });
}

/// Returns the least room along one axis with which a shape fits, given the room along the other
/// two.
int BoxPacking::least_length(std::size_t number, int width, int height) {
    const Shape shape = shapes_[number];
    if (shape.num_parts <= 1) return 1;
    if (halvings(width) + halvings(height) >= shape.depth) return 1;
    const std::array<std::size_t, 3> key{number, static_cast<std::size_t>(width),
                                         static_cast<std::size_t>(height)};
    if (const auto known = lengths_.find(key); known != lengths_.end()) return known->second;
    int least = least_length(shape.lower, width, height) + least_length(shape.upper, width, height);
    least = std::min(least, shared_length(shape, width, height));
    least = std::min(least, shared_length(shape, height, width));
    return lengths_[key] = least;
}

/// Returns the least room along one axis with which both children fit if the cut divides `width`
/// between them.
int BoxPacking::shared_length(const Shape& shape, int width, int height) {
    const auto length = [&](std::size_t child, int part_of_width) {
        return least_length(child, std::min(part_of_width, height),
                            std::max(part_of_width, height));
    };
    const auto longer = [&](int below) {
        return std::max(length(shape.lower, below), length(shape.upper, width - below));
    };
    if (width < 2) return shape.num_parts;
    // With more width below the cut, the lower child needs less length and the upper child more.
    // The larger of both is least where they cross.
    const int crossing = least_number(1, width - 2, [&](int below) {
        return length(shape.lower, below) <= length(shape.upper, width - below);
    });
    return crossing > 1 ? std::min(longer(crossing), longer(crossing - 1)) : longer(crossing);
}

int most_parts(const Room& room, const TreeShape& shape, int most) {
    std::int64_t units = 1;
    for (const int count : room) units = std::min<std::int64_t>(units * count, most);
    const auto too_many = [&](int num_parts) {
        const std::vector<double> sizes(num_parts, 1.0);
        return !BoxPacking(sizes, shape).fits(root_of(num_parts, shape), room);
    };
    return least_number(1, static_cast<int>(units), too_many) - 1;
}

}  // namespace rrcb
