#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/points.hpp>
#include <rrcb/transfer.hpp>

#include <mpi.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <ranges>
#include <span>
#include <type_traits>
#include <vector>

namespace rrcb {

namespace detail {

class KeptExchange;
struct CutoffAccess;

}  // namespace detail

/// Number of periods along each axis.
using Shift = std::array<std::int32_t, 3>;

/// Determines whose radius counts, if points have different radii.
enum class Needs : std::int32_t {
    scatter,   ///< a rank needs the points whose radii reach one of its parts
    gather,    ///< a rank needs the points within the radius of one of its own points
    symmetric  ///< a rank needs both: two points meet within the larger of their radii
};

/// Points to send and to receive as ghosts. Each list of ranks is in ascending order and contains a
/// rank at most once.
struct GhostPlan {
    LocalIndex num_points = 0;    ///< of this rank
    std::vector<RankCount> send;  ///< number of points for each rank
    /// Indices of the points to send: for the first rank of `send` in ascending order, then for the
    /// second, ...
    std::vector<LocalIndex> send_indices;
    std::vector<RankCount> receive;  ///< number of ghosts from each rank
    std::optional<Box> periodic{};   ///< repeated box, if there is one
    std::vector<Shift> shifts{};     ///< of each ghost, in the order of fetch(), if a box repeats
    Stamp stamp{};                   ///< of the call, see unstamped()
    std::optional<double> cutoff{};  ///< of all points, as in the options
    Needs needs = Needs::scatter;    ///< as in the options
    /// Memory that fetch() and similar functions keep for the next call. Copies of the plan share
    /// it. Reset it to free it.
    mutable std::shared_ptr<detail::KeptExchange> kept{};
};

/// Distance within which points are needed, in the unit of the coordinates: one for all points, or
/// one for each.
class Cutoff {
  public:
    /// No distance, which no call accepts. Not collective, as all of these.
    Cutoff() = default;
    /// One distance for all points.
    Cutoff(double distance) : of_all_(distance) {}
    /// One distance for each point of this rank, borrowed: a vector or an array of doubles.
    template <class Distances>
    requires std::is_convertible_v<const Distances&, std::span<const double>> Cutoff(
        const Distances& distances)
        : of_each_(std::span<const double>(distances)) {}

  private:
    friend struct detail::CutoffAccess;
    std::optional<double> of_all_{};
    std::optional<std::span<const double>> of_each_{};
};

/// Distances within which points are needed, and the ranks of the parts. All options must be the
/// same on every rank, except a cutoff for each point: either every rank with points gives one, or
/// none does.
struct GhostOptions {
    /// One distance for all points, or one for each; for contacts of spheres, give the diameters.
    /// By default the distances of the points sent count (see `needs`): if two points on different
    /// ranks are nearer than the larger of their distances, the point with the larger one is a
    /// ghost on the other point's rank; the other point need not be a ghost. To meet each pair
    /// once, use ghost g of point p only if cutoff(g) > cutoff(p), or if they are equal and id(g) >
    /// id(p). An id is any number of a point that is the same on all ranks.
    Cutoff cutoff{};
    /// Periodic box that contains all points: [lower, upper) along each axis with finite ends.
    /// Along axes with infinite ends it is not periodic. Wrap positions first; a point on an upper
    /// face, where rounding may put it, is treated as if it were just below the face. A rank may
    /// need several images of one point, even of its own points. Each image is a ghost with its own
    /// entry in GhostPlan::shifts: the image of x is at x + shift * (upper - lower), with each
    /// operation rounded to a double.
    std::optional<Box> periodic{};
    /// Ranks of each part, for example after a remap(), if they are not those of ranks_of_part().
    std::optional<std::span<const RankRange>> ranks_of_parts{};
    /// Determines whose radii count. Except with Needs::scatter a part gets two sets of points:
    /// those within its largest radius of the box of its points that have more than half this
    /// radius, and those within its largest other radius of the box of its other points. Cost: a
    /// pass of counts, two reductions, one of which has up to 14 doubles for each part, and two
    /// passes over the points.
    Needs needs = Needs::scatter;
};

/// Finds from the cuts the points that other ranks need. Collective.
///
///     const rrcb::GhostPlan near = rrcb::ghost_plan(balance.cuts, points, comm, {.cutoff = 0.1});
///
/// A rank needs the points of others whose distance from the closed region of one of its parts is
/// at most the radius, plus round-off. If points are outside the regions of their rank, as members
/// of groups may be, add the largest such distance to the radius.
/// @param cuts    of a balance, to whose ranks the points were transferred
/// @param points  of this rank, after transfer()
/// @param options radius, periodic box, ranks of the parts
/// @param comm    of the balance, or a congruent one
/// Throws the same Error on every rank: for unusable points, points that have yet to leave their
/// rank, a radius that is not finite, negative or above 100 periods, a position outside the
/// periodic box, options or cuts that differ between ranks, another communicator, or no memory.
/// Cost: as plan(); a periodic box adds a pass of counts, and `needs` adds what is written there.
RRCB_API GhostPlan ghost_plan(const Cuts& cuts, const Points& points, MPI_Comm comm,
                              const GhostOptions& options);

/// Moves fetched positions of ghosts to those of their images. Does nothing without a periodic box.
/// If rounding leaves an image in [lower, upper), it is moved to the next number outside. Not
/// collective.
///
/// @param plan      of the ghosts
/// @param positions the coordinates of one ghost after the other
/// Throws Error if the positions do not fit the plan.
RRCB_API void apply_shifts(const GhostPlan& plan, std::span<double> positions);
/// Moves floats in the same way: computes each position as a double, then rounds it. Not
/// collective.
///
/// @param plan      of the ghosts
/// @param positions the coordinates of one ghost after the other
RRCB_API void apply_shifts(const GhostPlan& plan, std::span<float> positions);

namespace detail {

/// Moves positions in the arrays of a view.
RRCB_API void apply_shifts(const GhostPlan& plan, const Points& positions);

RRCB_API void move(const GhostPlan& plan, std::span<const ByteColumn> columns,
                   const TransferOptions& options, MPI_Comm comm);

/// Moves columns of ghosts to the ranks of their points, where they are in the order of
/// plan.send_indices. Copies the columns of the points to their results. Collective.
RRCB_API void move_back(const GhostPlan& plan, std::span<const ByteColumn> of_ghosts,
                        std::span<const ByteColumn> of_points, const TransferOptions& options,
                        MPI_Comm comm);

/// A plan of ghosts, along which ranks send rows back.
struct Replies {
    const GhostPlan& plan;
};

RRCB_API void move(const Replies& replies, std::span<const ByteColumn> columns,
                   const TransferOptions& options, MPI_Comm comm);

template <class T>
void add_each(std::span<const LocalIndex> points, std::size_t components, const T* values,
              T* sums) {
    static_assert(std::is_arithmetic_v<T>, "only numbers can be added");
    for (std::size_t k = 0; k < points.size(); ++k)
        for (std::size_t c = 0; c < components; ++c) {
            T& sum = sums[points[k] * components + c];
            sum = static_cast<T>(sum + values[k * components + c]);
        }
}

template <class... T>
std::tuple<std::vector<T>...> accumulated(const GhostPlan& plan,
                                          const std::tuple<Column<T>...>& of_ghosts,
                                          const std::tuple<Column<T>...>& of_points, MPI_Comm comm,
                                          const TransferOptions& options) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
        std::tuple<std::vector<T>...> arrived;
        std::tuple<std::vector<T>...> sums;
        const std::array<ByteColumn, sizeof...(T)> sent{
            byte_column(std::get<I>(of_ghosts), std::get<I>(arrived))...};
        const std::array<ByteColumn, sizeof...(T)> kept{
            byte_column(std::get<I>(of_points), std::get<I>(sums))...};
        move_back(plan, sent, kept, options, comm);
        (add_each(plan.send_indices, std::get<I>(of_points).components, std::get<I>(arrived).data(),
                  std::get<I>(sums).data()),
         ...);
        return sums;
    }
    (std::index_sequence_for<T...>{});
}

template <class GhostColumn, class PointColumn>
auto accumulated(const GhostPlan& plan, const GhostColumn& of_ghosts, const PointColumn& of_points,
                 MPI_Comm comm, const TransferOptions& options) {
    return std::get<0>(accumulated(plan, std::tuple(column(of_ghosts)),
                                   std::tuple(column(of_points)), comm, options));
}

}  // namespace detail

/// Moves positions in structs in the same way. Not collective.
///
///     rrcb::apply_shifts(near, ghosts, &Particle::position);
///
/// @param plan   of the ghosts
/// @param ghosts as fetched, one struct for each ghost
/// @param first  a member that is an array, or the member for the first axis
/// @param others members for the other axes
/// Throws Error if the positions do not fit the plan.
template <std::ranges::contiguous_range Structs, class Member, class... Others>
void apply_shifts(const GhostPlan& plan, Structs& ghosts, Member first, Others... others) {
    static_assert(!std::is_const_v<std::remove_reference_t<decltype(*std::ranges::data(ghosts))>>,
                  "the ghosts are moved and cannot be const");
    detail::apply_shifts(plan, Points(ghosts, first, others...));
}

/// Returns columns of the ghosts of this rank. Collective.
///
///     const std::vector<double> ghost_xyz = rrcb::fetch(near, rrcb::column(xyz, 3), comm);
///
/// The plan can be used as long as no point changes its index in the columns. With a skin s in its
/// radii, it contains all pairs within the true radii until a point has moved by s / 2; do not wrap
/// positions until then. If the columns have the same types as before and no transfer was made
/// since, ranks only exchange messages with the ranks in the plan, and throw as Neighbours does.
/// @param plan    from ghost_plan()
/// @param columns one entry, or `components`, for each of plan.num_points points
/// @param comm    of the plan
/// @param options  as for transfer()
/// @return ghosts in ascending order of ranks, then in the order of send_indices on their rank
/// Throws Error as transfer(), and if the points were transferred since the plan was made.
template <class Columns>
[[nodiscard]] auto fetch(const GhostPlan& plan, const Columns& columns, MPI_Comm comm,
                         const TransferOptions& options = {}) {
    return detail::moved(plan, columns, comm, options);
}

/// Returns the rows that the ranks of the ghosts send back, such as answers to queries. Collective.
///
///     const std::vector<double> answers = rrcb::reply(asked, answer_to_each_ghost, comm);
///
/// Ghosts with `radii` are queries: each point is sent to the ranks of all parts that its ball
/// touches.
/// @param plan          from ghost_plan()
/// @param ghost_columns one entry, or `components`, for each ghost, in the order of fetch()
/// @param comm          of the plan
/// @param options        as for transfer()
/// @return a row for each entry of plan.send_indices: row k belongs to point send_indices[k]
/// Throws Error as transfer(). Cost: as fetch().
template <class GhostColumns>
[[nodiscard]] auto reply(const GhostPlan& plan, const GhostColumns& ghost_columns, MPI_Comm comm,
                         const TransferOptions& options = {}) {
    return detail::moved(detail::Replies{plan}, ghost_columns, comm, options);
}

/// Returns columns of the points, to which the values of their ghosts on other ranks have been
/// added, such as forces. This is the reverse of fetch(). Collective.
///
/// @param plan          from ghost_plan()
/// @param ghost_columns for each ghost as many numbers as `columns` have for each point, in the
/// order of fetch()
/// @param columns       numbers of the same types for each of plan.num_points points
/// @param comm          of the plan
/// @param options        as for transfer()
/// @return for each point its value plus the values of its ghosts, added in ascending order of
/// ranks; the same arguments give bit-identical results. Integers must be able to hold the sums
/// Throws Error as transfer(). Cost: as fetch(), and memory for the values that arrive.
template <class GhostColumns, class Columns>
[[nodiscard]] auto accumulate(const GhostPlan& plan, const GhostColumns& ghost_columns,
                              const Columns& columns, MPI_Comm comm,
                              const TransferOptions& options = {}) {
    return detail::accumulated(plan, ghost_columns, columns, comm, options);
}

}  // namespace rrcb
