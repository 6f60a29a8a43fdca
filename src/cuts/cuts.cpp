#include "arithmetic/infinity.hpp"
#include "cuts/tree.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <rrcb/cuts.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>

namespace rrcb {

namespace {

/// Returns the cut of a node; throws Error if it is illegal.
const Cut& legal_cut(const Cuts& cuts, const Descent& at) {
    const Cut& cut = cuts.tree[at.node];
    require(cut.axis >= 0 && cut.axis < cuts.dimension && !std::isnan(cut.at[cut.axis]),
            illegal_cut);
    return cut;
}

/// Throws Error unless the tree has one cut for each node.
void check_shape(const Cuts& cuts) {
    check_dimension(cuts.dimension, "cuts");
    const auto num_nodes = static_cast<std::size_t>(std::max(cuts.num_parts, 1)) - 1;
    require(cuts.num_parts >= 1 && cuts.tree.size() == num_nodes,
            "the tree must hold one cut less than there are parts");
    const TreeShape& shape = cuts.shape;
    require(shape.round_robin_block == 0 ||
                (shape.group_size >= 1 && shape.number_fits(cuts.num_parts)),
            "the shape of the cuts must be one for so many parts; keep it with the cuts");
    require(cuts.numbers.empty() || std::ssize(cuts.numbers) == cuts.num_parts, illegal_numbers);
}

/// Returns true if no position is above `lower` and below `upper`, which are cuts across the same
/// axis. Null stands for an open side.
bool leave_nothing(const Cut* lower, const Cut* upper, int dimension) {
    if (lower == nullptr && upper == nullptr) return false;
    if (lower == nullptr) return upper->at[upper->axis] == -infinity;
    if (upper == nullptr) return lower->at[lower->axis] == infinity;
    const bool holds_divided =
        upper->divides != 0 &&
        std::equal(lower->at.begin(), lower->at.begin() + dimension, upper->at.begin());
    return is_above(*upper, lower->at, dimension) && !holds_divided;
}

/// Calls visit(part) for each part at or below `at` that touches a box.
template <class Visit>
void visit_touching(const Cuts& cuts, const Descent& at, const Box& box, Visit&& visit) {
    if (at.is_part()) return visit(at.first_part);
    const Cut& cut = legal_cut(cuts, at);
    const Sides sides = sides_of(box, cut, cuts.dimension);
    if (sides.below || holds_divided_points(box, cut, cuts.dimension))
        visit_touching(cuts, at.lower(), box, visit);
    if (sides.above) visit_touching(cuts, at.upper(), box, visit);
}

}  // namespace

Cut plane(int axis, double value) {
    Cut cut{axis, 0, {-infinity, -infinity, -infinity}};
    cut.at[axis] = value;
    return cut;
}

bool is_plane(const Cut& cut, int dimension) {
    for (int a = 0; a < dimension; ++a)
        if (a != cut.axis && cut.at[a] != -infinity) return false;
    return true;
}

bool is_above(const Cut& cut, const Vector& position, int dimension) {
    const int axis = cut.axis;
    if (position[axis] != cut.at[axis]) return position[axis] > cut.at[axis];
    for (int a = 0; a < dimension; ++a)
        if (a != axis && position[a] != cut.at[a]) return position[a] > cut.at[a];
    return true;
}

int num_levels(const TreeShape& shape, int num_parts) {
    const auto halvings = [](int number) {
        return std::bit_width(static_cast<unsigned>(number - 1));
    };
    const int group_size = std::max(shape.group_size, 1);
    return halvings((num_parts - 1) / group_size + 1) + halvings(std::min(group_size, num_parts));
}

Part end_of(const Cuts& cuts, Part part) {
    if (cuts.numbers.empty()) return cuts.shape.end_of(part, cuts.num_parts);
    const auto at = std::ranges::find(cuts.numbers, part);
    require(at != cuts.numbers.end(), illegal_numbers);
    return static_cast<Part>(at - cuts.numbers.begin());
}

std::vector<Part> numbers_of(const Cuts& cuts) {
    std::vector<Part> numbers;
    for (Part end = 0; end < cuts.num_parts; ++end) numbers.push_back(cuts.part_at(end));
    return numbers;
}

void number_parts(const Cuts& cuts, std::span<Part> ends) {
    if (cuts.is_numbered_in_order()) return;
    for (Part& end : ends) end = cuts.part_at(end);
}

Descent node_at(const Cuts& cuts, std::size_t node) {
    Descent at = root_of(cuts);
    while (at.node != node) at = node >= at.upper().node ? at.upper() : at.lower();
    return at;
}

Box region_of(const Cuts& cuts, Part part) {
    Box region = everywhere;
    for (Descent at = root_of(cuts); !at.is_part(); at = at.towards(part)) {
        const Cut& cut = legal_cut(cuts, at);
        region = at.is_above(part) ? box_above(region, cut) : box_below(region, cut);
    }
    return region;
}

bool is_region_empty(const Cuts& cuts, Part part, const Box& region) {
    // A region can be empty only if its bounds are equal or reversed along an axis.
    bool may_be_empty = false;
    for (int a = 0; a < cuts.dimension; ++a)
        may_be_empty = may_be_empty || !(region.lower[a] < region.upper[a]);
    if (!may_be_empty) return false;
    // Nearest cut on both sides along each axis, in the order of positions across them.
    std::array<const Cut*, max_dimension> lower{};
    std::array<const Cut*, max_dimension> upper{};
    for (Descent at = root_of(cuts); !at.is_part(); at = at.towards(part)) {
        const Cut& cut = legal_cut(cuts, at);
        const Cut*& nearest = (at.is_above(part) ? lower : upper)[cut.axis];
        const bool is_nearer =
            nearest == nullptr || (at.is_above(part) ? is_above(*nearest, cut.at, cuts.dimension)
                                                     : is_above(cut, nearest->at, cuts.dimension));
        if (is_nearer) nearest = &cut;
    }
    for (std::size_t a = 0; a < max_dimension; ++a)
        if (leave_nothing(lower[a], upper[a], cuts.dimension)) return true;
    return false;
}

Part part_of(const Cuts& cuts, const Vector& position) {
    for (int a = 0; a < cuts.dimension; ++a)
        if (std::isnan(position[a])) [[unlikely]]
            return no_part;
    return cuts.part_at(descend(cuts, position, root_of(cuts)).first_part);
}

Box box_of(const Cuts& cuts, Part part) {
    check_shape(cuts);
    if (part < 0 || part >= cuts.num_parts)
        reject("part " + std::to_string(part) + " is none of the " +
               std::to_string(cuts.num_parts) + " parts of the cuts; they count from 0");
    const Part end = end_of(cuts, part);
    const Box region = region_of(cuts, end);
    return is_region_empty(cuts, end, region) ? Box{} : region;
}

namespace {

std::vector<Part> parts_touching_sides(const Cuts& cuts, const Box& box) {
    check_shape(cuts);
    std::vector<Part> parts;
    for (int a = 0; a < cuts.dimension; ++a) {
        require(!std::isnan(box.lower[a]) && !std::isnan(box.upper[a]),
                "the bounds of the box must be numbers, or infinite on open sides");
        if (box.lower[a] > box.upper[a]) return parts;
    }
    visit_touching(cuts, root_of(cuts), box, [&](Part part) {
        if (!is_region_empty(cuts, part, region_of(cuts, part))) parts.push_back(part);
    });
    number_parts(cuts, parts);
    if (!cuts.is_numbered_in_order()) std::ranges::sort(parts);
    return parts;
}

}  // namespace

std::vector<Part> parts_touching(const Cuts& cuts, const Box& box) {
    return locally([&] { return parts_touching_sides(cuts, box); });
}

}  // namespace rrcb
