#pragma once

#include "cuts/tree.hpp"

#include <array>
#include <map>
#include <span>
#include <vector>

namespace rrcb {

/// Number of boxes that fit next to each other along each axis.
using Room = std::array<int, max_dimension>;

/// Determines whether a bisection fits into a room, if each part takes one unit along each axis.
///
/// Enough units are not sufficient: of random rooms with at least as many units as parts, 8 % in
/// 2-D and 18 % in 3-D have no bisection. A cut divides the room along its axis: i units are below
/// it, the others above. A node fits if there is an axis and a division with which both children
/// fit. More room never harms, so for given room along two axes there is a least room along the
/// third. It is found by recursion over the shapes of nodes; halving makes only two shapes per
/// level if no part has size 0.
///
/// A closed formula, with halvings across two axes and then a row along the third, would refuse
/// rooms that fit: 10 % of them in 2-D and 16 % in 3-D, for rooms with up to 1.5 units per part.
class BoxPacking {
  public:
    /// Takes the relative sizes of the parts. Parts of size 0 need no room.
    BoxPacking(std::span<const double> sizes, const TreeShape& shape);

    int num_parts(const Descent& at) const { return shapes_[shape_of(at)].num_parts; }

    bool fits(const Descent& at, const Room& room) { return fits(shape_of(at), room); }

    /// Returns the least room along `axis` with which the node fits, or more than `most` if `most`
    /// is not enough. Does not read room[axis].
    int least_room(const Descent& at, int axis, Room room, int most);

  private:
    struct Shape {
        std::size_t lower = 0;
        std::size_t upper = 0;
        int num_parts = 0;
        int depth = 0;  ///< number of levels of cuts below it
    };
    static constexpr std::size_t empty = 0;
    static constexpr std::size_t single = 1;

    std::size_t add_node(std::span<const double> sizes, const Descent& at);
    std::size_t shape_with(std::size_t lower, std::size_t upper);
    std::size_t shape_of(const Descent& at) const;
    bool fits(std::size_t shape, const Room& room);
    int least_length(std::size_t shape, int width, int height);
    int shared_length(const Shape& shape, int width, int height);

    std::vector<Shape> shapes_;
    /// number of each shape, by its children
    std::map<std::array<std::size_t, 2>, std::size_t> numbers_;
    std::vector<std::size_t> shape_of_node_;  ///< shapes in preorder of the nodes
    std::vector<std::size_t> shape_of_part_;
    /// results of least_length() so far
    std::map<std::array<std::size_t, 3>, int> lengths_;
};

/// Returns the largest number of parts of equal size, up to `most`, that fit in a tree of this
/// shape.
int most_parts(const Room& room, const TreeShape& shape, int most);

}  // namespace rrcb
