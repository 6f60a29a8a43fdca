#pragma once

#include <rrcb/balance.hpp>
#include <rrcb/detail/bisection.hpp>
#include <rrcb/detail/moments.hpp>
#include <rrcb/detail/uninitialized.hpp>

#include <mpi.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace rrcb {

/// Count, weight, box and extreme positions of one rank's points.
///
/// `first[a]` and `last[a]` are the first and the last position in the order across axis a: by the
/// coordinate on a, with ties broken by the other axes in ascending order. They are infinite if
/// there are no points.
struct PointSummary {
    LocalIndex count = 0;  ///< of the points
    double weight = 0;     ///< sum of the weights; number of points if every point weighs 1
    /// smallest weight of a point
    double lightest = std::numeric_limits<double>::infinity();
    double heaviest = 0;  ///< largest weight of a point
    Box box{};            ///< of the positions
    std::array<Vector, max_dimension> first = all_at(std::numeric_limits<double>::infinity());
    std::array<Vector, max_dimension> last = all_at(-std::numeric_limits<double>::infinity());

  private:
    static constexpr std::array<Vector, max_dimension> all_at(double value) {
        const Vector corner{value, value, value};
        return {corner, corner, corner};
    }
};

/// Returns the summary of points on the host. Not collective.
///
/// Throws Error if the arrays do not fit together, or for illegal weights or coordinates; the text
/// contains the first of them and their number.
RRCB_API PointSummary summary_of(const Points& points);

/// Some points of one rank.
struct PointSample {
    std::vector<Vector> positions;  ///< 0 beyond the dimension
    std::vector<double> weights{};  ///< one per point, or empty if every point weighs 1
};

/// Totals of one rank's points in each part.
struct PartTotals {
    std::vector<double> weights;  ///< one per part; the counts if every point weighs 1
    std::vector<double> counts;   ///< one per part
};

/// Copies of the open points of one rank, and the totals of its settled points. A point is open if
/// its part is not yet known, because a cut may end on either side of it; all others are settled.
struct Collected {
    int dimension = 0;                            ///< of the points
    detail::Uninitialized<double> coordinates{};  ///< `dimension` for each point
    detail::Uninitialized<double> weights{};  ///< one per point, or empty if every point weighs 1
    detail::Uninitialized<LocalIndex> original{};  ///< index among all points of this rank
    PartTotals settled{};                          ///< of the settled points

    /// Returns the number of open points.
    LocalIndex count() const { return original.size(); }
    /// Returns the weight of an open point.
    double weight(LocalIndex k) const { return weights.empty() ? 1.0 : weights[k]; }
    /// Returns a coordinate of an open point.
    double coordinate(LocalIndex k, int axis) const {
        return coordinates[k * static_cast<LocalIndex>(dimension) + static_cast<LocalIndex>(axis)];
    }
    /// Returns the position of an open point; 0 beyond the dimension.
    Vector position(LocalIndex k) const {
        Vector x{};
        for (int a = 0; a < dimension; ++a) x[static_cast<std::size_t>(a)] = coordinate(k, a);
        return x;
    }
};

/// A node of the tree of cuts whose cut may end in another interval than the one searched before.
struct Wanted {
    Part first_part = 0;  ///< lowest part of the node
    int num_parts = 0;    ///< parts of the node
    int axis = 0;         ///< of its cut
    Bracket interval{};   ///< lower <= x < upper

    /// Returns true if a coordinate on the axis is in the interval.
    bool contains(double x) const { return x >= interval.lower && x < interval.upper; }
};

class OpenPoints;  // of the engine

/// Access to the points of one rank and their parts, wherever these are stored. It has all
/// functions that a balance needs of them.
///
/// A balance calls these functions on each rank, in any order after summary() or assign(), and uses
/// nothing but their results. Positions and weights must not change during a call. Until renumber()
/// is called, parts are ends of the tree of cuts. No function may communicate. Each may throw Error
/// or std::bad_alloc, which is then thrown on all ranks. A result of wrong length is an Error on
/// all ranks as well.
class RRCB_API PointPasses {
  public:
    /// Destroys the passes, but not the points.
    virtual ~PointPasses() = default;

    /// Returns the dimension, 1 to 3. It must be the same on every rank.
    virtual int dimension() const = 0;
    /// Returns the number of points of this rank.
    virtual LocalIndex count() const = 0;
    /// Returns true if the points have weights. All ranks with points must return the same.
    virtual bool has_weights() const = 0;

    /// Sets whether weights count from now on; if not, every point weighs 1. At first they count.
    virtual void use_weights(bool are_used) = 0;

    /// Reads the weights and, if `reads_positions`, the positions; otherwise the box and the
    /// extreme positions remain infinite.
    ///
    /// Throws Error for the first NaN or infinite coordinate, and for the first negative, NaN or
    /// infinite weight.
    virtual PointSummary summary(bool reads_positions) = 0;

    /// Returns `size` random points with their weights, the same in every call. If there are at
    /// most `size` points, returns all of them in their order.
    virtual PointSample sample(LocalIndex size) = 0;

    /// Returns the moments of the cells of a mesh, as cell_moments(). All points are in the box of
    /// the mesh.
    virtual std::vector<CellMoments> moments(const SupportMesh& mesh) = 0;

    /// Gives each point its part, see is_above().
    ///
    /// @param cuts   a complete tree
    /// @param counts whether the totals of the parts are returned
    /// Throws Error for the first NaN or infinite coordinate.
    virtual PartTotals assign(const Cuts& cuts, bool counts) = 0;

    /// Opens the points that may get another part while the cuts move in their intervals, as
    /// collect() describes; opens all points if `cuts` has no tree. The result replaces collect(),
    /// collect_more(), boxes() and settle(), and borrows the cuts. If it returns null, the engine
    /// calls these functions and keeps copies of the open points; all passes of this version do
    /// that.
    ///
    /// @param cuts      as for collect(), or without a tree
    /// @param intervals one per cut
    /// @param has_parts whether the points have the parts given by these cuts
    virtual std::unique_ptr<OpenPoints> open(const Cuts& cuts, std::span<const Bracket> intervals,
                                             bool has_parts);

    /// Collects the points that may get another part while the cuts move in their intervals, lower
    /// <= cut <= upper, in ascending order of their indices, and gives them no_part. All other
    /// points get, or already have, their part: a coordinate below `lower` is below such a cut, a
    /// coordinate of `upper` or more is above it.
    ///
    /// @param cuts      a complete tree
    /// @param intervals one per cut
    /// @param has_parts whether the points have the parts given by these cuts; at a cut that
    /// divides coincident points they may be on either side
    /// @param collected gets the points; its memory is reused
    virtual void collect(const Cuts& cuts, std::span<const Bracket> intervals, bool has_parts,
                         Collected& collected) = 0;

    /// Collects settled points in other intervals, and gives them no_part.
    ///
    /// @param wanted    nodes of which none is above or below another
    /// @param collected gets the points, and loses them from its totals
    /// @return the index of the wanted node of each new point
    virtual std::vector<std::size_t> collect_more(std::span<const Wanted> wanted,
                                                  Collected& collected) = 0;

    /// Returns the box of the points of each part. Points with no_part are left out.
    virtual std::vector<Box> boxes(int num_parts) = 0;

    /// Gives the collected points their parts.
    ///
    /// @param collected points
    /// @param parts     one for each
    virtual void settle(const Collected& collected, std::span<const Part> parts) = 0;

    /// Replaces each part p by `numbers[p]`. If there is only one number, all points get it.
    virtual void renumber(std::span<const Part> numbers) = 0;

    /// Returns a copy of the parts of all points.
    virtual std::vector<Part> parts() const = 0;
    /// Gives the points the parts in a copy that parts() has returned.
    virtual void set_parts(std::span<const Part> parts) = 0;

    /// Returns how many cells of a mesh moments() can add up fast; a mesh that is chosen
    /// automatically has no more.
    virtual std::int64_t most_cells() const { return std::numeric_limits<std::int64_t>::max(); }
};

/// Divides points that only passes can read. The passes keep the parts, and Balance::parts is
/// empty. Collective.
///
/// @param points   of this rank; a rank without points needs passes as well
/// @param options  must be the same on every rank
/// @param previous as for balance()
/// @param comm     as for balance()
/// @return the cuts and a report
/// Throws the same Error on every rank, as balance(), and for what passes throw. Cost: see
/// docs/design/how_it_works.md. Only summaries, cells, totals and collected points are copied out
/// of the passes.
RRCB_API Balance balance(PointPasses& points, MPI_Comm comm, const Options& options = {},
                         const Cuts& previous = {});

}  // namespace rrcb
