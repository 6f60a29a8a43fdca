#pragma once

#include "cuts/tree.hpp"

#include <array>
#include <map>
#include <span>
#include <vector>

namespace rrcb {

/// Number of boxes with room side by side along each axis.
using Room = std::array<int, max_dimension>;

/// Finds whether a bisection has room, if each part takes one unit of room along each axis.
///
/// Enough units do not suffice: of random rooms with as many units as parts, or more, 8 % in 2-D
/// and 18 % in 3-D have no bisection. A cut divides the room along its axis: i units below, the
/// others above. A node fits if some axis and division fit both children. More room never harms, so
/// there is a least room along one axis for given room along the others. It is found by recursion
/// over the shapes of nodes, of which halving makes two per level if no part has size 0.
///
/// A closed formula, halvings across two axes and then a row along the third, would refuse 10 % in
/// 2-D and 16 % in 3-D of the rooms that fit if they have up to 1.5 units for each part.
class BoxPacking {
  public:
    /// Takes the relative sizes of the parts; with size 0 they take no room.
    BoxPacking(std::span<const double> sizes, const TreeShape& shape);

    int num_parts(const Descent& at) const { return shapes_[shape_of(at)].num_parts; }

    bool fits(const Descent& at, const Room& room) { return fits(shape_of(at), room); }

    /// Returns the least room along `axis` in which the node fits; more than `most` if that is not
    /// enough. Does not read room[axis].
    int least_room(const Descent& at, int axis, Room room, int most);

  private:
    struct Shape {
        std::size_t lower = 0;
        std::size_t upper = 0;
        int num_parts = 0;
        int depth = 0;  ///< levels of cuts below it
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
    std::map<std::array<std::size_t, 2>, std::size_t> numbers_;  ///< of shapes, by children
    std::vector<std::size_t> shape_of_node_;                     ///< in preorder
    std::vector<std::size_t> shape_of_part_;
    std::map<std::array<std::size_t, 3>, int> lengths_;  ///< found so far
};

/// Returns the most parts of equal size, up to `most`, with room in a tree of this shape.
int most_parts(const Room& room, const TreeShape& shape, int most);

}  // namespace rrcb
