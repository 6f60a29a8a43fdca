#pragma once

#include <rrcb/points.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace comparisons {

/// Cut-off and machines that ghosts are counted by.
struct GhostRule {
    std::optional<double> radius{};       ///< above 0; without it twice the mean spacing
    std::optional<int> ranks_per_node{};  ///< machines hold so many consecutive parts
};

/// Copies of points that parts need from other parts.
struct GhostSums {
    explicit GhostSums(int num_parts);

    /// A copy that a part needs of a point of another one.
    void add(rrcb::Part part, rrcb::Part from, std::optional<int> ranks_per_node);

    std::vector<std::int64_t> needed;         ///< by each part
    std::int64_t off_machine = 0;             ///< those of them from parts on another machine
    std::vector<unsigned char> are_touching;  ///< parts p and q at p * num_parts + q: 0 or 1
};

/// Cubes over a box, a little wider than the cut-off and at most 2^20 along an axis.
class CutOffGrid {
  public:
    CutOffGrid(const rrcb::Box& box, double radius);

    /// Index of the cube along an axis, 0 ... 2^20, of a finite coordinate inside the box.
    std::int64_t index(double coordinate, std::size_t axis) const;

    /// Orders cubes by their index on axis 0, then 1, then 2; open to steps of one in each
    /// direction.
    std::int64_t key(const rrcb::Vector& position) const;

    static constexpr int bits = 21;  ///< of a key, for each axis

  private:
    rrcb::Vector lower_;
    double side_;
};

/// Finds the points near those of other parts: points sorted by cubes of the cut-off.
class CellList {
  public:
    /// Points in cubes whose index on axis 0 is not in first_layer ... end_layer - 1 are only
    /// neighbours of others.
    CellList(const std::vector<rrcb::Vector>& points, const rrcb::Box& box, double radius,
             std::int64_t first_layer, std::int64_t end_layer);

    /// Adds the ghosts that parts need of the points in those layers; parts[i] holds point i.
    void count(std::span<const rrcb::Part> parts, std::optional<int> ranks_per_node,
               GhostSums& sums) const;

  private:
    struct Cell {
        std::int64_t key;
        std::size_t begin;  ///< of its points
    };

    struct Groups;

    Groups group(std::span<const rrcb::Part> parts) const;
    bool are_near(std::size_t i, std::size_t j) const;
    void find_parts_near(std::size_t point, rrcb::Part part, const Groups& groups,
                         std::span<const std::size_t> cells, std::vector<rrcb::Part>& found) const;

    double squared_radius_;
    std::vector<std::size_t> order_;    ///< indices of the points, sorted by cubes
    std::vector<rrcb::Vector> points_;  ///< in that order
    std::vector<Cell> cells_;           ///< and one behind the last
    std::size_t first_cell_ = 0;        ///< in the layers
    std::size_t end_cell_ = 0;
};

}  // namespace comparisons
