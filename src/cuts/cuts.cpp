#include "cuts/tree.hpp"
#include "options/rejection.hpp"

#include <rrcb/cuts.hpp>

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The cut of a node that the look-up can't do without.
const Cut& known_cut(const Cuts& cuts, const Descent& at) {
    const Cut* cut = find_cut(cuts, at.node);
    if (cut == nullptr) reject_unknown();
    return *cut;
}

void collect_touching(const Cuts& cuts, const Box& box, Descent at, std::vector<Part>& parts) {
    if (at.is_part()) {
        parts.push_back(at.first_part);
        return;
    }
    const Cut& cut = known_cut(cuts, at);
    const Sides sides = sides_of(box, cut, cuts.dimension);
    if (sides.below || holds_divided_points(box, cut, cuts.dimension))
        collect_touching(cuts, box, at.lower(), parts);
    if (sides.above) collect_touching(cuts, box, at.upper(), parts);
}

}  // namespace

bool is_plane(const Cut& cut, int dimension) {
    for (int a = 0; a < dimension; ++a)
        if (a != cut.axis && cut.at[static_cast<std::size_t>(a)] != -infinity) return false;
    return true;
}

bool is_above(const Cut& cut, const Vector& position, int dimension) {
    const auto axis = static_cast<std::size_t>(cut.axis);
    if (position[axis] != cut.at[axis]) return position[axis] > cut.at[axis];
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
        if (a != axis && position[a] != cut.at[a]) return position[a] > cut.at[a];
    return true;
}

void reject_unknown() {
    reject(
        "a look-up needs cuts that this rank does not know; all ranks together call locate() for "
        "the parts of points, or whole_cuts() for look-ups of any kind");
}

Descent descend(const Cuts& cuts, const Vector& position, Descent at) {
    while (!at.is_part()) {
        const Cut* cut = find_cut(cuts, at.node);
        if (cut == nullptr) break;
        at = is_above(*cut, position, cuts.dimension) ? at.upper() : at.lower();
    }
    return at;
}

Descent node_at(const Cuts& cuts, std::size_t node) {
    Descent at = root_of(cuts);
    while (at.node != node) at = node >= at.upper().node ? at.upper() : at.lower();
    return at;
}

Part part_of(const Cuts& cuts, const Vector& position) {
    Descent at = root_of(cuts);
    if (!is_whole(cuts)) [[unlikely]] {
        at = descend(cuts, position, at);
        return at.is_part() ? at.first_part : no_part;
    }
    while (!at.is_part())
        at = is_above(cuts.tree[at.node], position, cuts.dimension) ? at.upper() : at.lower();
    return at.first_part;
}

Box box_of(const Cuts& cuts, Part part) {
    Box box;
    box.lower.fill(-infinity);
    box.upper.fill(infinity);
    Descent at = root_of(cuts);
    while (!at.is_part()) {
        const Cut& cut = known_cut(cuts, at);
        const auto axis = static_cast<std::size_t>(cut.axis);
        const bool above = part >= at.upper().first_part;
        if (above) box.lower[axis] = std::max(box.lower[axis], cut.at[axis]);
        if (!above) box.upper[axis] = std::min(box.upper[axis], cut.at[axis]);
        at = above ? at.upper() : at.lower();
    }
    return box;
}

std::vector<Part> parts_touching(const Cuts& cuts, const Box& box) {
    std::vector<Part> parts;
    for (std::size_t a = 0; a < static_cast<std::size_t>(cuts.dimension); ++a)
        if (!(box.lower[a] <= box.upper[a])) return parts;
    collect_touching(cuts, box, root_of(cuts), parts);
    return parts;
}

}  // namespace rrcb
