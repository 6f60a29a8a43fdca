#include "cell_list.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace comparisons {

namespace {

constexpr std::int64_t max_index = std::int64_t{1} << 20;

constexpr std::int64_t key_of(std::int64_t i, std::int64_t j, std::int64_t k) {
    return (((i << CutOffGrid::bits) + j) << CutOffGrid::bits) + k;
}

void widen(rrcb::Box& box, const rrcb::Vector& x) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lower[axis] = std::min(box.lower[axis], x[axis]);
        box.upper[axis] = std::max(box.upper[axis], x[axis]);
    }
}

/// From a position to the nearest one in the box, no more than to any point in it as computed.
double squared_distance(const rrcb::Vector& x, const rrcb::Box& box) {
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double distance = x[axis] - std::clamp(x[axis], box.lower[axis], box.upper[axis]);
        squared += distance * distance;
    }
    return squared;
}

/// Walks through sorted cubes and finds the neighbours of each: three consecutive ones in nine
/// rows.
template <typename Cells>
class Neighbourhood {
  public:
    explicit Neighbourhood(const Cells& cells) : cells_(cells) {}

    /// Of a cube not before that of the previous call; itself included.
    const std::vector<std::size_t>& of(std::int64_t key) {
        found_.clear();
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            const std::int64_t middle =
                key + key_of(static_cast<int>(row) / 3 - 1, static_cast<int>(row) % 3 - 1, 0);
            std::size_t& first = rows_[row];
            while (cells_[first].key < middle - 1) ++first;
            for (std::size_t c = first; cells_[c].key <= middle + 1; ++c) found_.push_back(c);
        }
        return found_;
    }

  private:
    const Cells& cells_;
    std::array<std::size_t, 9> rows_{};
    std::vector<std::size_t> found_;
};

}  // namespace

GhostSums::GhostSums(int number)
    : needed(static_cast<std::size_t>(number)), are_touching(needed.size() * needed.size()) {}

void GhostSums::add(rrcb::Part part, rrcb::Part from, std::optional<int> ranks_per_node) {
    const auto row = static_cast<std::size_t>(part);
    ++needed[row];
    are_touching[row * needed.size() + static_cast<std::size_t>(from)] = 1;
    if (ranks_per_node && part / *ranks_per_node != from / *ranks_per_node) ++off_machine;
}

CutOffGrid::CutOffGrid(const rrcb::Box& box, double radius) : lower_(box.lower) {
    // Wider by more than an index is rounded by, so that points within the radius are neighbours.
    side_ = radius * (1 + 1e-6);
    for (std::size_t axis = 0; axis < 3; ++axis)
        side_ = std::max(side_, (box.upper[axis] - box.lower[axis]) / max_index * (1 + 1e-6));
}

std::int64_t CutOffGrid::index(double coordinate, std::size_t axis) const {
    const double index = (coordinate - lower_[axis]) / side_;
    if (!(index > 0)) return 0;
    return index < max_index ? static_cast<std::int64_t>(index) : max_index;
}

std::int64_t CutOffGrid::key(const rrcb::Vector& position) const {
    return key_of(index(position[0], 0) + 1, index(position[1], 1) + 1, index(position[2], 2) + 1);
}

/// Points of each cube by part.
struct CellList::Groups {
    struct Group {
        rrcb::Part part;
        std::size_t begin;  ///< of its points
        std::size_t end;
        rrcb::Box box;  ///< around them
    };

    std::vector<std::size_t> points;  ///< indices of sorted points
    std::vector<Group> groups;
    std::vector<std::size_t> starts;  ///< of the groups of each cube, and one behind the last

    std::span<const Group> of(std::size_t cell) const {
        return std::span(groups).subspan(starts[cell], starts[cell + 1] - starts[cell]);
    }

    /// Whether all points of these cubes are in one part.
    bool are_one(std::span<const std::size_t> cells) const {
        const rrcb::Part part = of(cells.front()).front().part;
        return std::ranges::all_of(
            cells, [&](std::size_t c) { return of(c).size() == 1 && of(c).front().part == part; });
    }
};

CellList::CellList(const std::vector<rrcb::Vector>& points, const rrcb::Box& box, double radius,
                   std::int64_t first_layer, std::int64_t end_layer)
    : squared_radius_(radius * radius) {
    const CutOffGrid grid(box, radius);
    std::vector<std::pair<std::int64_t, std::size_t>> keys;
    for (std::size_t i = 0; i < points.size(); ++i) keys.emplace_back(grid.key(points[i]), i);
    std::ranges::sort(keys);
    for (const auto& [key, point] : keys) {
        if (cells_.empty() || cells_.back().key != key) cells_.push_back({key, order_.size()});
        order_.push_back(point);
        points_.push_back(points[point]);
    }
    const auto cell_at = [&](std::int64_t layer) {
        const auto found =
            std::ranges::lower_bound(cells_, key_of(layer + 1, 0, 0), {}, &Cell::key);
        return static_cast<std::size_t>(found - cells_.begin());
    };
    first_cell_ = cell_at(first_layer);
    end_cell_ = cell_at(end_layer);
    cells_.push_back({std::numeric_limits<std::int64_t>::max(), order_.size()});
}

bool CellList::are_near(std::size_t i, std::size_t j) const {
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double distance = points_[i][axis] - points_[j][axis];
        squared += distance * distance;
    }
    return squared <= squared_radius_;
}

void CellList::find_parts_near(std::size_t point, rrcb::Part part, const Groups& groups,
                               std::span<const std::size_t> cells,
                               std::vector<rrcb::Part>& found) const {
    found.clear();
    for (const std::size_t cell : cells) {
        for (const Groups::Group& group : groups.of(cell)) {
            if (group.part == part || std::ranges::find(found, group.part) != found.end()) continue;
            const auto is_near = [&](std::size_t j) { return are_near(point, j); };
            const auto first = groups.points.begin();
            if (squared_distance(points_[point], group.box) <= squared_radius_ &&
                std::any_of(first + group.begin, first + group.end, is_near))
                found.push_back(group.part);
        }
    }
}

CellList::Groups CellList::group(std::span<const rrcb::Part> parts) const {
    const auto part_of = [&](std::size_t point) { return parts[order_[point]]; };
    Groups result;
    result.points.resize(order_.size());
    std::iota(result.points.begin(), result.points.end(), std::size_t{0});
    for (std::size_t cell = 0; cell + 1 < cells_.size(); ++cell) {
        result.starts.push_back(result.groups.size());
        const auto begin = result.points.begin();
        std::sort(begin + cells_[cell].begin, begin + cells_[cell + 1].begin,
                  [&](std::size_t a, std::size_t b) { return part_of(a) < part_of(b); });
        for (std::size_t i = cells_[cell].begin; i < cells_[cell + 1].begin; ++i) {
            const rrcb::Part part = part_of(result.points[i]);
            const rrcb::Vector& x = points_[result.points[i]];
            if (i == cells_[cell].begin || result.groups.back().part != part)
                result.groups.push_back({part, i, i, {x, x}});
            result.groups.back().end = i + 1;
            widen(result.groups.back().box, x);
        }
    }
    result.starts.push_back(result.groups.size());
    return result;
}

void CellList::count(std::span<const rrcb::Part> parts, std::optional<int> ranks_per_node,
                     GhostSums& sums) const {
    const Groups groups = group(parts);
    Neighbourhood neighbourhood(cells_);
    std::vector<rrcb::Part> found;
    for (std::size_t cell = first_cell_; cell < end_cell_; ++cell) {
        const std::vector<std::size_t>& near = neighbourhood.of(cells_[cell].key);
        if (groups.are_one(near)) continue;
        for (std::size_t i = cells_[cell].begin; i < cells_[cell + 1].begin; ++i) {
            const rrcb::Part part = parts[order_[i]];
            find_parts_near(i, part, groups, near, found);
            for (const rrcb::Part other : found) sums.add(other, part, ranks_per_node);
        }
    }
}

}  // namespace comparisons
