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

/// Count, weight, box and ends of one rank's points.
///
/// `first[a]` and `last[a]` are the first and the last position in the order across axis a: by the
/// coordinate on a, ties by the other axes in ascending order. Infinite if there are no points.
struct PointSummary {
    LocalIndex count = 0;  ///< of the points
    double weight = 0;     ///< of all; their number if every point weighs 1
    double lightest = std::numeric_limits<double>::infinity();  ///< weight of one point
    double heaviest = 0;                                        ///< likewise
    Box box{};                                                  ///< of the positions
    std::array<Vector, max_dimension> first = all_at(std::numeric_limits<double>::infinity());
    std::array<Vector, max_dimension> last = all_at(-std::numeric_limits<double>::infinity());

  private:
    static constexpr std::array<Vector, max_dimension> all_at(double value) {
        const Vector corner{value, value, value};
        return {corner, corner, corner};
    }
};

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

/// Copies of the points of one rank whose part is open, because a cut may still end beyond them,
/// and the totals of the others, which are settled.
struct Collected {
    int dimension = 0;                            ///< of the points
    detail::Uninitialized<double> coordinates{};  ///< `dimension` for each point
    detail::Uninitialized<double> weights{};      ///< one per point, or empty if every one weighs 1
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

/// A node of the tree of cuts whose cut may end in another interval than before.
struct Wanted {
    Part first_part = 0;  ///< lowest part of the node
    int num_parts = 0;    ///< parts of the node
    int axis = 0;         ///< of its cut
    Bracket interval{};   ///< lower <= x < upper

    /// Returns true if a coordinate on the axis is in the interval.
    bool contains(double x) const { return x >= interval.lower && x < interval.upper; }
};

class OpenPoints;  // of the engine

/// The points of one rank and their parts, wherever they are: all questions of a balance to them.
///
/// A balance calls these functions on each rank, in any order after summary() or assign(), and does
/// everything else with their answers. Positions and weights do not change during a call. Parts are
/// ends of the tree of cuts, in its order, until renumber(). Each function is local: none may
/// communicate. Each may throw Error or std::bad_alloc, which is thrown on all ranks. Results of
/// other lengths than asked for are an Error on all ranks as well.
class RRCB_API PointPasses {
  public:
    /// Ends the passes; the points stay.
    virtual ~PointPasses() = default;

    /// Returns the dimension, 1 to 3, the same on every rank.
    virtual int dimension() const = 0;
    /// Returns the number of points of this rank.
    virtual LocalIndex count() const = 0;
    /// Returns true if the points have weights, on every rank with points alike.
    virtual bool has_weights() const = 0;

    /// States whether weights count from now on; if not, every point weighs 1. They do at first.
    virtual void use_weights(bool are_used) = 0;

    /// Reads weights, and the positions if `reads_positions`; else the box and ends stay infinite.
    ///
    /// Throws Error for the first NaN or infinite coordinate, and for the first negative, NaN or
    /// infinite weight.
    virtual PointSummary summary(bool reads_positions) = 0;

    /// Returns `size` points at random with their weights, the same in every call, or all points in
    /// their order if there are no more.
    virtual PointSample sample(LocalIndex size) = 0;

    /// Returns the moments of the cells of a mesh, as cell_moments(). All points are in its box.
    virtual std::vector<CellMoments> moments(const SupportMesh& mesh) = 0;

    /// Gives each point its part, see is_above().
    ///
    /// @param cuts   whole
    /// @param counts whether the totals of the parts are returned
    /// Throws Error for the first NaN or infinite coordinate.
    virtual PartTotals assign(const Cuts& cuts, bool counts) = 0;

    /// Opens the points that some place of the cuts in their intervals would bring to another part,
    /// as collect(); all points if `cuts` has no tree. The answer stands for collect(),
    /// collect_more(), boxes() and settle(), and borrows the cuts. Returns null if the engine is to
    /// call these instead, and to keep copies of the open points, as all passes of this version do.
    ///
    /// @param cuts      as for collect(); without a tree none
    /// @param intervals one per cut
    /// @param has_parts the points have the parts by these cuts
    virtual std::unique_ptr<OpenPoints> open(const Cuts& cuts, std::span<const Bracket> intervals,
                                             bool has_parts);

    /// Collects the points that some place of the cuts in their intervals, lower <= cut <= upper,
    /// would bring to another part, in ascending order of their indices, and gives them no_part;
    /// the others get or have their part. A coordinate below `lower` is below such a cut, one from
    /// `upper` on above it.
    ///
    /// @param cuts      whole
    /// @param intervals one per cut
    /// @param has_parts the points have the parts by these cuts; at a dividing cut they may be
    /// on either side
    /// @param collected whose memory is reused
    virtual void collect(const Cuts& cuts, std::span<const Bracket> intervals, bool has_parts,
                         Collected& collected) = 0;

    /// Collects settled points in other intervals, and gives them no_part.
    ///
    /// @param wanted    nodes without a common part
    /// @param collected to which they are added, and from whose totals they are taken
    /// @return the wanted node of each new point
    virtual std::vector<std::size_t> collect_more(std::span<const Wanted> wanted,
                                                  Collected& collected) = 0;

    /// Returns the box of the points of each part, but for those with no_part.
    virtual std::vector<Box> boxes(int num_parts) = 0;

    /// Gives the collected points their parts.
    ///
    /// @param collected points
    /// @param parts     one for each
    virtual void settle(const Collected& collected, std::span<const Part> parts) = 0;

    /// Replaces each part p by `numbers[p]`; by the only number, if there is one, whatever it was.
    virtual void renumber(std::span<const Part> numbers) = 0;

    /// Returns a copy of the parts of all points.
    virtual std::vector<Part> parts() const = 0;
    /// Gives the points the parts of such a copy.
    virtual void set_parts(std::span<const Part> parts) = 0;

    /// Returns how many cells of a mesh moments() adds up fast; an automatic mesh has no more.
    virtual std::int64_t most_cells() const { return std::numeric_limits<std::int64_t>::max(); }
};

/// Divides points which only passes can read; the parts stay with them, and Balance::parts is
/// empty. Collective.
///
/// @param points   of this rank; a rank without points has passes as well
/// @param options  the same on every rank
/// @param previous as for balance()
/// @param comm     as for balance()
/// @return the cuts and a report
/// Throws Error as balance(), and what passes throw, on every rank alike. Cost: see
/// docs/design/how_it_works.md. The engine gets summaries, cells, totals and collected points.
RRCB_API Balance balance(PointPasses& points, const Options& options, const Cuts& previous,
                         MPI_Comm comm);

}  // namespace rrcb
