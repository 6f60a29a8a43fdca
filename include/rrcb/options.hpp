#pragma once

#include <rrcb/tree_shape.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace rrcb {

/// Accuracy to which the estimated cuts are corrected by counting points.
enum class Refine {
    none,       ///< not at all: the estimate from the statistics stands
    tolerance,  ///< until the counted imbalance is within `imbalance_tolerance`
    exact       ///< to the weighted median: each cut to within the weight of one point, which goes
                ///< where it makes the side less too heavy, or further to fill parts of equal size;
                ///< a bisection that the ranks hold already is kept if its cuts are as exact
};

/// Treatment of coincident points at a balanced cut.
enum class Coincident {
    together,  ///< they share a part: the part of a position is the part of its points
    divide     ///< some go to each side, from lower ranks below; look-ups find one of their
               ///< parts
};

/// Lines of a grid across an axis: at origin + k * spacing for whole numbers k, as doubles compute
/// it, the product first.
struct GridLines {
    double origin = 0;   ///< of line 0
    double spacing = 0;  ///< > 0 and finite
};

/// Rule for the axis of a cut. Axes within a tenth of the best are equal to it;
/// the first of them is taken.
class AxisOrder {
  public:
    /// As fewest_ghosts().
    AxisOrder() = default;

    /// Cuts each box across the axis with the least weight near the cut, as estimated: those points
    /// are ghosts of the other side.
    static AxisOrder fewest_ghosts() { return {}; }

    /// Cuts each box across its own longest axis, as Zoltan's RCB.
    static AxisOrder longest() { return {Kind::longest, {}}; }

    /// As fewest_ghosts(), across some axes only: among({2}) makes layers. Names one or more axes
    /// of the points, the preferred ones first.
    static AxisOrder among(std::vector<int> axes) { return {Kind::among, std::move(axes)}; }

    /// Makes all cuts across the first of `axes`, then all across the next; names each axis once.
    /// Warning: it may leave 1.4 times the ghosts of fewest_ghosts().
    static AxisOrder grouped(std::vector<int> axes) { return {Kind::grouped, std::move(axes)}; }

    /// Makes cut k of Cuts::tree across axes[k]; one axis for each cut, num_parts - 1.
    static AxisOrder given(std::vector<int> axes) { return {Kind::given, std::move(axes)}; }

    /// Returns true if made by longest(). Not collective, as all of these.
    bool is_longest() const { return kind_ == Kind::longest; }
    /// Returns true if made by among().
    bool is_among() const { return kind_ == Kind::among; }
    /// Returns true if made by grouped().
    bool is_grouped() const { return kind_ == Kind::grouped; }
    /// Returns true if made by given().
    bool is_given() const { return kind_ == Kind::given; }
    /// Returns the axes given to it; none for fewest_ghosts() and longest().
    const std::vector<int>& axes() const { return axes_; }

  private:
    enum class Kind { fewest_ghosts, longest, among, grouped, given };

    AxisOrder(Kind kind, std::vector<int> axes) : kind_(kind), axes_(std::move(axes)) {}

    Kind kind_ = Kind::fewest_ghosts;
    std::vector<int> axes_;
};

/// Axes to cut, and the positions of cuts along them. All limits hold at once.
struct Axes {
    AxisOrder order{};  ///< such as AxisOrder::longest(); default: fewest_ghosts()
    /// Planes only: points on a plane stay together, above it, and regions are half-open boxes.
    bool plain = false;

    /// Steps of the program from one call to the next, > 0 and finite: the more, the sooner cuts of
    /// `previous` turn to axes with fewer ghosts, which pay in each step.
    double steps = 50;

    /// Least extent of every part along each axis, > 0 and finite, one per axis of the points;
    /// empty: any. Between two cuts `upper - lower >= min_width` holds as doubles compute it. On a
    /// side without a cut the extent ends at the bounding box of all points of the call. Along an
    /// axis without cuts there is no limit. Parts of size 0 have no extent.
    std::vector<double> min_width{};

    /// Cuts on these lines only, one entry per axis of the points; empty: anywhere. Such cuts are
    /// plain, whether `plain` is set or not; each part holds at least one cell of the grid.
    std::vector<GridLines> grid{};
};

/// Settings of the cost of a call; the defaults suit most programs.
struct Tuning {
    int support_mesh = 0;  ///< cells per axis of each rank's support mesh, up to 4096, in
                           ///< 3-D 256; 0: by its points

    /// Most parts made by rank 0 without the others, at least 2. If there are more, and more
    /// ranks, each cut is found by a rank of its parts. No effect with Refine::none,
    /// Axes::min_width, Axes::grid or AxisOrder::grouped().
    int central_parts = 4096;
};

/// Options of `balance`; must be the same on every rank, which is checked.
struct Options {
    int num_parts = 0;                  ///< parts to make; 0: one per rank
    std::vector<double> part_sizes{};   ///< relative weight of each part, >= 0, some > 0; empty:
                                        ///< equal
    double imbalance_tolerance = 1.01;  ///< heaviest part / mean part to reach, >= 1, finite
    Refine refine = Refine::tolerance;  ///< accuracy of the cuts

    /// No effect with Refine::none and with plain cuts.
    Coincident coincident = Coincident::together;

    Axes axes{};  ///< axes and positions of the cuts

    /// Shape of the tree of cuts. With a group_size of 0 machines are separated first, so that less
    /// is sent between machines. That needs as many ranks on each machine, or fewer on the last,
    /// and as many parts on each rank. Ranks are consecutive on a machine, or dealt to the machines
    /// in turn; the latter only if rank 0 makes all parts. Otherwise, and on 1, 2, 4, ... full
    /// machines with consecutive ranks, the parts are halved. A call from earlier cuts keeps their
    /// shape.
    TreeShape tree{0};
    Tuning tuning{};  ///< for experts
};

}  // namespace rrcb
