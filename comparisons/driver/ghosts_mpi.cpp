#include "ghosts_mpi.hpp"

#include "failure_mpi.hpp"

#include <rrcb/transfer.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace comparisons {

namespace {

constexpr std::int64_t max_index = std::int64_t{1} << 20;
constexpr int index_bits = 21;

void widen(rrcb::Box& box, const rrcb::Vector& x) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lower[axis] = std::min(box.lower[axis], x[axis]);
        box.upper[axis] = std::max(box.upper[axis], x[axis]);
    }
}

/// The positions of this rank's finite points, and their indices.
struct FinitePoints {
    explicit FinitePoints(const rrcb::Points& points) {
        for (std::size_t i = 0; i < points.count; ++i) {
            const rrcb::Vector x = points.position(i);
            if (!std::ranges::all_of(x, [](double at) { return std::isfinite(at); })) continue;
            indices.push_back(i);
            positions.push_back(x);
            widen(box, x);
        }
    }

    std::vector<std::size_t> indices;
    std::vector<rrcb::Vector> positions;
    rrcb::Box box;
};

/// Returns some positions of all ranks, at equal distances in the order of ranks and points.
std::vector<rrcb::Vector> sample_of(const std::vector<rrcb::Vector>& mine, MPI_Comm comm) {
    constexpr std::int64_t most = 128;
    const auto count = static_cast<std::int64_t>(mine.size());
    std::int64_t end = 0;
    MPI_Scan(&count, &end, 1, MPI_INT64_T, MPI_SUM, comm);
    std::int64_t all = 0;
    MPI_Allreduce(&count, &all, 1, MPI_INT64_T, MPI_SUM, comm);
    std::vector<rrcb::Vector> sample(static_cast<std::size_t>(std::min(most, all)));
    for (std::size_t k = 0; k < sample.size(); ++k) {
        const std::int64_t i =
            static_cast<std::int64_t>(k) * all / std::ssize(sample) - (end - count);
        if (i >= 0 && i < count) sample[k] = mine[static_cast<std::size_t>(i)];
    }
    MPI_Allreduce(MPI_IN_PLACE, sample.data(), 3 * static_cast<int>(sample.size()), MPI_DOUBLE,
                  MPI_SUM, comm);
    return sample;
}

/// Returns the median distance of some points to their nearest neighbour. The median ignores the
/// few points that are far from all others. Returns 1 if all points coincide, when any radius would
/// do.
double median_spacing(const std::vector<rrcb::Vector>& mine, MPI_Comm comm) {
    const std::vector<rrcb::Vector> sample = sample_of(mine, comm);
    std::vector<double> nearest(sample.size(), std::numeric_limits<double>::infinity());
    for (const rrcb::Vector& x : mine)
        for (std::size_t k = 0; k < sample.size(); ++k) {
            const double distance =
                std::hypot(x[0] - sample[k][0], x[1] - sample[k][1], x[2] - sample[k][2]);
            if (distance > 0) nearest[k] = std::min(nearest[k], distance);
        }
    MPI_Allreduce(MPI_IN_PLACE, nearest.data(), static_cast<int>(nearest.size()), MPI_DOUBLE,
                  MPI_MIN, comm);
    if (nearest.empty()) return 1;
    const auto middle = nearest.begin() + std::ssize(nearest) / 2;
    std::ranges::nth_element(nearest, middle);
    return std::isfinite(*middle) ? *middle : 1;
}

/// A grid of cubes over a box. Its layers are perpendicular to the longest axis of the box.
struct CubeGrid {
    CubeGrid(const rrcb::Box& box, double radius) : lower(box.lower) {
        const auto extent = [&](std::size_t axis) { return box.upper[axis] - box.lower[axis]; };
        for (const std::size_t axis : {1, 2})
            if (extent(axis) > extent(across)) across = axis;
        // The cubes are a little wider than the radius. Points within the radius are therefore in
        // neighbouring cubes in spite of round-off.
        side = std::max(radius, extent(across) / max_index) * (1 + 1e-6);
        num_layers = layer(box.upper) + 1;
    }

    std::int64_t index(const rrcb::Vector& x, std::size_t axis) const {
        const double index = (x[axis] - lower[axis]) / side;
        if (!(index > 0)) return 0;
        return index < max_index ? static_cast<std::int64_t>(index) : max_index;
    }
    std::int64_t layer(const rrcb::Vector& x) const { return index(x, across); }

    /// Returns the number of the cube of a position. Neighbouring cubes of all directions have
    /// numbers too.
    std::int64_t cube(const rrcb::Vector& x) const {
        const std::int64_t row = ((layer(x) + 1) << index_bits) + index(x, (across + 1) % 3) + 1;
        return (row << index_bits) + index(x, (across + 2) % 3) + 1;
    }

    rrcb::Vector lower;
    std::size_t across = 0;
    double side = 0;
    std::int64_t num_layers = 0;
};

std::int64_t layer_of(std::int64_t cube) {
    return (cube >> 2 * index_bits) - 1;
}

int rank_of_layer(std::int64_t layer, std::int64_t num_layers, int num_ranks) {
    return static_cast<int>(std::clamp<std::int64_t>(layer, 0, num_layers - 1) * num_ranks /
                            num_layers);
}

/// The points of one part in one cube, and their bounding box.
struct Group {
    std::int64_t cube;
    rrcb::Part part;
    std::span<const PointInCube> points;
    rrcb::Box box;

    /// Returns whether one of the points is within the radius of a position.
    bool is_near(const rrcb::Vector& x, double squared_radius) const {
        const auto squared_distance = [&](const auto& nearest) {
            double squared = 0;
            for (std::size_t axis = 0; axis < 3; ++axis)
                squared += (x[axis] - nearest(axis)) * (x[axis] - nearest(axis));
            return squared;
        };
        // The computed distance to the box is at most that to any point in it.
        const auto in_box = [&](std::size_t axis) {
            return std::clamp(x[axis], box.lower[axis], box.upper[axis]);
        };
        return squared_distance(in_box) <= squared_radius &&
               std::ranges::any_of(points, [&](const PointInCube& point) {
                   const auto at = [&](std::size_t axis) { return point.position[axis]; };
                   return squared_distance(at) <= squared_radius;
               });
    }
};

/// Sorts the points by cube and part, and groups them.
std::vector<Group> grouped(std::vector<PointInCube>& points, const std::vector<rrcb::Part>& parts) {
    const auto key = [&](const PointInCube& point) {
        return std::pair(point.cube, parts[point.number]);
    };
    std::ranges::sort(points, {}, key);
    std::vector<Group> groups;
    for (auto first = points.begin(); first != points.end();) {
        const auto end = std::find_if(first, points.end(), [&](const PointInCube& point) {
            return key(point) != key(*first);
        });
        Group& group = groups.emplace_back(
            Group{first->cube, parts[first->number], std::span(first, end), {}});
        for (const PointInCube& point : group.points) widen(group.box, point.position);
        first = end;
    }
    return groups;
}

/// The sums over the ghosts that the parts need.
struct Sums {
    explicit Sums(int num_parts)
        : needed(static_cast<std::size_t>(num_parts)),
          are_touching(needed.size() * needed.size()) {}

    /// Counts a ghost: a point of the part `from` that `part` needs.
    void add(rrcb::Part part, rrcb::Part from, int ranks_per_node) {
        ++needed[part];
        are_touching[part * needed.size() + from] = 1;
        off_machine += part / ranks_per_node != from / ranks_per_node;
    }

    /// Returns the sums over all ranks. Collective.
    Ghosts over_all(double radius, bool has_machines, MPI_Comm comm) {
        const int num_parts = static_cast<int>(needed.size());
        MPI_Allreduce(MPI_IN_PLACE, needed.data(), num_parts, MPI_INT64_T, MPI_SUM, comm);
        MPI_Allreduce(MPI_IN_PLACE, &off_machine, 1, MPI_INT64_T, MPI_SUM, comm);
        Ghosts ghosts{radius, std::reduce(needed.begin(), needed.end()), std::ranges::max(needed)};
        // Reduces one row at a time, because the number of entries may exceed an int.
        for (auto row = are_touching.begin(); row != are_touching.end(); row += num_parts) {
            MPI_Allreduce(MPI_IN_PLACE, &*row, num_parts, MPI_UNSIGNED_CHAR, MPI_MAX, comm);
            const auto neighbours = static_cast<int>(std::count(row, row + num_parts, 1));
            ghosts.most_neighbours = std::max(ghosts.most_neighbours, neighbours);
        }
        if (has_machines) ghosts.off_machine = off_machine;
        ghosts.of_parts = needed;
        return ghosts;
    }

    std::vector<std::int64_t> needed;         ///< ghosts of each part
    std::int64_t off_machine = 0;             ///< ghosts from parts on another machine
    std::vector<unsigned char> are_touching;  ///< entry p * num_parts + q is 1 if part p needs
                                              ///< ghosts from part q
};

/// Finds the neighbours of groups, visited in ascending order. They are in nine rows of cubes, in
/// three consecutive cubes of each.
class Neighbourhood {
  public:
    explicit Neighbourhood(const std::vector<Group>& groups) : groups_(groups) {}

    /// Returns the nearby groups of other parts, by part. `group` must not precede that of the last
    /// call.
    const std::vector<const Group*>& of(const Group& group) {
        found_.clear();
        for (std::int64_t row = 0; row < 9; ++row) {
            const std::int64_t middle =
                group.cube + ((((row / 3 - 1) << index_bits) + row % 3 - 1) << index_bits);
            auto& first = firsts_[static_cast<std::size_t>(row)];
            while (first < groups_.size() && groups_[first].cube < middle - 1) ++first;
            for (std::size_t g = first; g < groups_.size() && groups_[g].cube <= middle + 1; ++g)
                if (groups_[g].part != group.part) found_.push_back(&groups_[g]);
        }
        std::ranges::sort(found_, {}, &Group::part);
        return found_;
    }

  private:
    const std::vector<Group>& groups_;
    std::array<std::size_t, 9> firsts_{};
    std::vector<const Group*> found_;
};

}  // namespace

GhostCounter::GhostCounter(const Workload& workload, const GhostRule& rule, MPI_Comm comm)
    : comm_(comm), rule_(rule) {
    const FinitePoints mine(workload.points());
    const rrcb::Box box = joined_box(mine.box, comm);
    radius_ = rule.radius ? *rule.radius : 2 * median_spacing(mine.positions, comm);
    const CubeGrid grid(box, radius_);
    num_layers_ = grid.num_layers;
    const int num_ranks = size_of(comm);
    std::vector<rrcb::Part> ranks;
    std::vector<rrcb::Vector> sent;
    for (std::size_t i = 0; i < mine.positions.size(); ++i) {
        const std::int64_t layer = grid.layer(mine.positions[i]);
        for (int step = -1, last = -1; step <= 1; ++step) {
            const int rank = rank_of_layer(layer + step, num_layers_, num_ranks);
            if (rank == std::exchange(last, rank)) continue;
            sources_.push_back(mine.indices[i]);
            sent.push_back(mine.positions[i]);
            ranks.push_back(rank);
        }
    }
    plan_ = rrcb::plan(ranks, num_ranks, comm);
    for (const rrcb::Vector& x : rrcb::transfer(plan_, sent, comm))
        points_.push_back({grid.cube(x), x, points_.size()});
}

Ghosts GhostCounter::count(const std::vector<rrcb::Part>& parts, int num_parts) const {
    std::vector<rrcb::Part> sent;
    for (const std::size_t i : sources_) sent.push_back(parts[i]);
    std::vector<PointInCube> points = points_;
    const std::vector<Group> groups = grouped(points, rrcb::transfer(plan_, sent, comm_));
    const int rank = rank_of(comm_);
    const int num_ranks = size_of(comm_);
    Neighbourhood neighbourhood(groups);
    Sums sums(num_parts);
    for (const Group& group : groups) {
        if (rank_of_layer(layer_of(group.cube), num_layers_, num_ranks) != rank) continue;
        const std::vector<const Group*>& others = neighbourhood.of(group);
        for (const PointInCube& point : group.points) {
            rrcb::Part last = group.part;
            for (const Group* other : others) {
                if (other->part == last || !other->is_near(point.position, radius_ * radius_))
                    continue;
                last = other->part;
                sums.add(last, group.part, rule_.ranks_per_node.value_or(num_parts));
            }
        }
    }
    return sums.over_all(radius_, rule_.ranks_per_node.has_value(), comm_);
}

}  // namespace comparisons
