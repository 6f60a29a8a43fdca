#pragma once

#include <rrcb/tree_shape.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace rrcb {

/// How accurately the estimated cuts are corrected by counting points.
enum class Refine {
    none,       ///< not at all: the estimate from the statistics is the result
    tolerance,  ///< until the counted imbalance is within `imbalance_tolerance`
    /// To the weighted median: each cut is exact to the weight of one point. This point goes to the
    /// side on which it leaves the smaller excess. If parts have equal sizes, cuts move further
    /// if that fills a part that would stay empty. A bisection that the ranks hold already is
    /// kept if its cuts are as exact.
    exact
};

/// Treatment of coincident points at a balanced cut.
enum class Coincident {
    together,  ///< they are in one part, so that a look-up of their position gives their part
    divide     ///< some go to each side, those from lower ranks below; a look-up gives one of their
               ///< parts
};

/// Lines of a grid across an axis. They are at origin + k * spacing for whole numbers k, computed
/// in doubles with the product first.
struct GridLines {
    double origin = 0;   ///< of line 0
    double spacing = 0;  ///< > 0 and finite
};

namespace detail {
struct AxisOrderAccess;
}  // namespace detail

/// Rule for the axis of a cut. Axes within a tenth of the best count as equal; the first of them is
/// taken.
class AxisOrder {
  public:
    /// The same as fewest_ghosts().
    AxisOrder() = default;

    /// Cuts each box across the axis with the least weight near the cut, according to an estimate.
    /// The points near a cut are ghosts of the other side.
    static AxisOrder fewest_ghosts() { return {}; }

    /// Cuts each box across its longest axis, as Zoltan's RCB does.
    static AxisOrder longest() { return {Kind::longest, {}}; }

    /// As fewest_ghosts(), but only across the given axes, preferred ones first: among({2}) makes
    /// layers.
    static AxisOrder among(std::vector<int> axes) { return {Kind::among, std::move(axes)}; }

    /// Makes all cuts across the first of `axes`, then all across the next, and so on. `axes` must
    /// contain each axis once. Warning: it may lead to 1.4 times the ghosts of fewest_ghosts().
    static AxisOrder grouped(std::vector<int> axes) { return {Kind::grouped, std::move(axes)}; }

    /// Makes cut k of Cuts::tree across axes[k]. `axes` must have one entry for each of the
    /// num_parts - 1 cuts.
    static AxisOrder given(std::vector<int> axes) { return {Kind::given, std::move(axes)}; }

  private:
    friend struct detail::AxisOrderAccess;
    enum class Kind { fewest_ghosts, longest, among, grouped, given };

    AxisOrder(Kind kind, std::vector<int> axes) : kind_(kind), axes_(std::move(axes)) {}

    Kind kind_ = Kind::fewest_ghosts;
    std::vector<int> axes_;
};

/// Axes that cuts are across, and allowed positions of cuts along them. All limits apply at the
/// same time.
struct Axes {
    AxisOrder order{};  ///< rule for the axes, such as AxisOrder::longest(); default:
                        ///< fewest_ghosts()
    /// If true, all cuts are planes: points on a plane stay together above it, and regions are
    /// half-open boxes.
    bool plain = false;

    /// Number of steps of your program from one call to the next, > 0 and finite. The more steps
    /// there are, the sooner cuts of `previous` turn to axes with fewer ghosts, because fewer
    /// ghosts pay in each step.
    double steps = 50;

    /// Least extent of every part along each axis, > 0 and finite, one per axis of the points;
    /// empty: no limit. Between two cuts the computed `upper - lower` is at least min_width. On a
    /// side without a cut, the extent ends at the bounding box of all points of the call. Along an
    /// axis without cuts there is no limit. Parts of size 0 have no extent.
    std::vector<double> min_width{};

    /// Grid whose lines the cuts must be on, one entry per axis of the points; empty: no grid. Such
    /// cuts are planes, whether `plain` is set or not. Each part contains at least one cell of the
    /// grid.
    std::vector<GridLines> grid{};
};

/// Options that few programs set. In C, Fortran and Python their names are those of these members,
/// such as `axes.min_width` and `cells_per_axis`.
struct ExpertOptions {
    /// Treatment of coincident points. No effect with Refine::none and with plain cuts. They stay
    /// together by default: the part that a look-up finds for a position is then that of all points
    /// there. The Zoltan plug-in divides them by default, as Zoltan's RCB.
    Coincident coincident = Coincident::together;

    Axes axes{};  ///< axes and positions of the cuts

    /// Shape of the tree of cuts. By default each cut halves the number of parts, so that the cuts
    /// do not depend on the machines of the job. With a group_size of 0, the first cuts separate
    /// machines, so that less is sent between machines. For this, all machines must have the same
    /// number of ranks (the last may have fewer), and all ranks the same number of parts. The ranks
    /// of a machine must be consecutive; if rank 0 makes all parts, they may also be dealt to the
    /// machines in turn. In other cases, and on 1, 2, 4, ... full machines with consecutive ranks,
    /// the parts are halved. A call from earlier cuts then keeps their shape.
    TreeShape tree{};

    int cells_per_axis = 0;  ///< cells per axis of each rank's support mesh, at most 4096 (256 in
                             ///< 3-D); 0: chosen from the number of points

    /// Largest number of parts that rank 0 makes without the others; at least 2. If there are more
    /// parts and more ranks, each cut is found by a rank of its parts. No effect with Refine::none,
    /// Axes::min_width, Axes::grid or AxisOrder::grouped().
    int max_root_parts = 4096;
};

/// Options of balance(). They must be the same on every rank, which is checked.
struct Options {
    int num_parts = 0;                  ///< parts to make; 0: one per rank
    std::vector<double> part_sizes{};   ///< relative weight of each part, each >= 0, some > 0;
                                        ///< empty: equal parts
    double imbalance_tolerance = 1.01;  ///< largest allowed heaviest part / mean part; >= 1 and
                                        ///< finite
    Refine refine = Refine::tolerance;  ///< accuracy of the cuts

    ExpertOptions expert{};  ///< the defaults suit most programs
};

}  // namespace rrcb
