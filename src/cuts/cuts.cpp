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

bool knows_path(const Cuts& cuts, Part part) {
    Descent at = root_of(cuts);
    while (!at.is_part() && find_cut(cuts, at.node) != nullptr)
        at = part >= at.upper().first_part ? at.upper() : at.lower();
    return at.is_part();
}

Descent node_at(const Cuts& cuts, std::size_t node) {
    Descent at = root_of(cuts);
    while (at.node != node) at = node >= at.upper().node ? at.upper() : at.lower();
    return at;
}

int depth_of(const Cuts& cuts, std::size_t node) {
    int depth = 0;
    for (Descent at = root_of(cuts); at.node != node; ++depth)
        at = node >= at.upper().node ? at.upper() : at.lower();
    return depth;
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
    return region_below(root_of(cuts), part,
                        [&](const Descent& at) -> const Cut& { return known_cut(cuts, at); });
}

std::vector<Part> parts_touching(const Cuts& cuts, const Box& box) {
    std::vector<Part> parts;
    for (std::size_t a = 0; a < static_cast<std::size_t>(cuts.dimension); ++a)
        if (!(box.lower[a] <= box.upper[a])) return parts;
    visit_touching(
        root_of(cuts), box, cuts.dimension,
        [&](const Descent& at) -> const Cut& { return known_cut(cuts, at); },
        [&](Part part) { parts.push_back(part); });
    return parts;
}

}  // namespace rrcb
