#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/transfer.hpp>
#include <rrcb/views.hpp>

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

}  // namespace detail

/// Periods along each axis.
using Shift = std::array<std::int32_t, 3>;

/// Whose radius counts, if points have different ones.
enum class Needs : std::int32_t {
    sender,    ///< a rank needs the points whose radii reach one of its parts
    receiver,  ///< it needs the points within the radius of a point of one of its parts
    either     ///< it needs both: the points within the greater of two radii
};

/// Points to send and to receive as ghosts. A list of ranks names each rank once, ascending.
struct GhostPlan {
    LocalIndex num_points = 0;    ///< of this rank
    std::vector<RankCount> send;  ///< number of points for each rank
    /// Indices of the points to send: for the first rank, ascending, then for the second, ...
    std::vector<LocalIndex> send_indices;
    std::vector<RankCount> receive;  ///< number of ghosts from each rank
    Box periodic{};                  ///< repeated box; empty: none
    std::vector<Shift> shifts{};     ///< of each ghost, in the order of fetch(), if a box repeats
    std::uint64_t group = 0;         ///< as Cuts::group
    /// Number of the call on this rank, with which fetch() recognizes ghosts from before a
    /// transfer. Set it to 0 if as many other points were transferred.
    std::uint64_t stamp = 0;
    double radius = std::numeric_limits<double>::quiet_NaN();  ///< as in the options
    Needs needs = Needs::sender;                               ///< as in the options
    /// Memory of fetch() and the like for the next call; copies share it. Reset it to free it.
    mutable std::shared_ptr<detail::KeptExchange> kept{};
};

/// Distances at which points are needed, and the ranks of the parts. The same on every rank, except
/// `radii`: every rank with points gives them, or none does.
struct GhostOptions {
    /// Cut-off of all points, in the unit of the coordinates; NaN: not given.
    double radius = std::numeric_limits<double>::quiet_NaN();
    /// One radius for each point instead; for contacts of spheres the diameters. Unless `needs`
    /// says otherwise: of two points on different ranks, nearer than the greater of their radii,
    /// the one with the greater radius is a ghost on the other's rank, the other not always. To
    /// meet each pair once, use a ghost only if its radius is greater than the point's, or equal
    /// and its id is greater; an id is any number of a point that is the same on all ranks.
    std::optional<std::span<const double>> radii{};
    /// Repeated box with all points, [lower, upper) along each axis with finite ends. Along the
    /// other axes, with infinite ends, it does not repeat. A point on an upper face, as
    /// wrapping may round it, is taken for one just below it. A rank may need several images of one
    /// point, also of its own. Each is a ghost with its entry in GhostPlan::shifts: the image of x
    /// is at x + shift * (upper - lower), each operation rounded to a double. Wrap positions first.
    std::optional<Box> periodic{};
    /// Ranks of each part, as after a remap(), if not ranks_of_part().
    std::optional<std::span<const RankRange>> ranks_of_parts{};
    /// Whose radii count. With the radii of receivers, a part gets the points within its greatest
    /// radius of the box of its points with more than half of it, and the points within the
    /// greatest other radius of the box of its other points. Cost: a pass of counts, two
    /// reductions, one of up to 14 doubles a part, and two passes over the points.
    Needs needs = Needs::sender;
};

/// Finds the points for other ranks from the cuts. Collective.
///
///     const rrcb::GhostPlan near = rrcb::ghosts(balance.cuts, points, {.radius = 0.1}, comm);
///
/// A rank needs the points of others at most the radius, plus round-off, away from the closed
/// region of one of its parts. If points are outside the regions of their rank, such as members of
/// groups, add the greatest of their distances from these to the radius.
/// @param cuts    of a balance, whose ranks have the points
/// @param points  of this rank, after transfer()
/// @param options radius, periodic box, ranks of the parts
/// @param comm    of the balance, or a congruent one
/// Throws Error on every rank alike: for unusable points, those of the balance if one has yet to
/// leave its rank, a radius that is not finite, below 0 or above 100 periods, a position outside
/// the periodic box, options or cuts that differ between ranks, another communicator, or no memory.
/// Cost: as plan(); a periodic box adds a pass of counts, `needs` what is written there.
RRCB_API GhostPlan ghosts(const Cuts& cuts, const Points& points, const GhostOptions& options,
                          MPI_Comm comm);

/// Moves fetched positions of ghosts to those of the images; does nothing without a periodic box.
/// Images left in [lower, upper) by rounding come to the next number outside. Not collective.
///
/// @param plan      of the ghosts
/// @param positions the axes of one ghost after the other
/// Throws Error if they do not fit the plan.
RRCB_API void apply_shifts(const GhostPlan& plan, std::span<double> positions);
/// Moves floats in the same way: rounds the position in doubles. Not collective.
///
/// @param plan      of the ghosts
/// @param positions the axes of one ghost after the other
RRCB_API void apply_shifts(const GhostPlan& plan, std::span<float> positions);

namespace detail {

/// Moves positions in the arrays of a view.
RRCB_API void apply_shifts(const GhostPlan& plan, const Points& positions);

RRCB_API void move(const GhostPlan& plan, std::span<const ByteColumn> columns,
                   const TransferLimits& limits, TransferReport* report, MPI_Comm comm);

/// Moves columns of ghosts to the ranks of their points, in the order of plan.send_indices there,
/// and copies the points' own. Collective.
RRCB_API void move_back(const GhostPlan& plan, std::span<const ByteColumn> of_ghosts,
                        std::span<const ByteColumn> of_points, const TransferLimits& limits,
                        TransferReport* report, MPI_Comm comm);

/// Plan of ghosts whose ranks send rows back.
struct Replies {
    const GhostPlan& plan;
};

RRCB_API void move(const Replies& replies, std::span<const ByteColumn> columns,
                   const TransferLimits& limits, TransferReport* report, MPI_Comm comm);

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
                                          const TransferLimits& limits, TransferReport* report) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
        std::tuple<std::vector<T>...> arrived;
        std::tuple<std::vector<T>...> sums;
        const std::array<ByteColumn, sizeof...(T)> sent{
            byte_column(std::get<I>(of_ghosts), std::get<I>(arrived))...};
        const std::array<ByteColumn, sizeof...(T)> kept{
            byte_column(std::get<I>(of_points), std::get<I>(sums))...};
        move_back(plan, sent, kept, limits, report, comm);
        (add_each(plan.send_indices, std::get<I>(of_points).components, std::get<I>(arrived).data(),
                  std::get<I>(sums).data()),
         ...);
        return sums;
    }
    (std::index_sequence_for<T...>{});
}

template <class GhostColumn, class PointColumn>
auto accumulated(const GhostPlan& plan, const GhostColumn& of_ghosts, const PointColumn& of_points,
                 MPI_Comm comm, const TransferLimits& limits, TransferReport* report) {
    return std::get<0>(accumulated(plan, std::tuple(column(of_ghosts)),
                                   std::tuple(column(of_points)), comm, limits, report));
}

}  // namespace detail

/// Moves positions in structs in the same way. Not collective.
///
///     rrcb::apply_shifts(near, ghosts, &Particle::position);
///
/// @param plan   of the ghosts
/// @param ghosts as fetched, one struct each
/// @param first  member, an array, or the number of the first axis
/// @param others members for the other axes
/// Throws Error if they do not fit the plan.
template <std::ranges::contiguous_range Structs, class Member, class... Others>
void apply_shifts(const GhostPlan& plan, Structs& ghosts, Member first, Others... others) {
    static_assert(!std::is_const_v<std::remove_reference_t<decltype(*std::ranges::data(ghosts))>>,
                  "the ghosts are moved and cannot be const");
    detail::apply_shifts(plan, member_points(ghosts, first, others...));
}

/// Returns columns of the ghosts of this rank. Collective.
///
///     const std::vector<double> ghost_xyz = rrcb::fetch(near, rrcb::column(xyz, 3), comm);
///
/// The plan can be used again as long as no point changes its index in the columns. With a skin s
/// in its radii, it holds all pairs within the true radii until a point has moved by s / 2; until
/// then do not wrap positions. For columns of the same types as before, if no transfer was made
/// since, ranks only exchange messages with those of the plan, and throw as Neighbours does.
/// @param plan    of ghosts()
/// @param columns one entry, or `components`, for each of plan.num_points points
/// @param comm    of the plan
/// @param limits  as for transfer()
/// @param report  as for transfer()
/// @return ghosts by ascending rank, in the order of send_indices there
/// Throws Error as transfer(), and if the points were transferred by a plan made since.
template <class Columns>
[[nodiscard]] auto fetch(const GhostPlan& plan, const Columns& columns, MPI_Comm comm,
                         const TransferLimits& limits = {}, TransferReport* report = nullptr) {
    return detail::moved(plan, columns, comm, limits, report);
}

/// Returns the rows sent back by the ranks of the ghosts, such as answers to queries. Collective.
///
///     const std::vector<double> answers = rrcb::reply(asked, answer_to_each_ghost, comm);
///
/// Ghosts by `radii` are queries: each point goes to the ranks of all parts touched by its ball.
/// @param plan          of ghosts()
/// @param ghost_columns one entry, or `components`, for each ghost, in the order of fetch()
/// @param comm          of the plan
/// @param limits        as for transfer()
/// @param report        as for transfer()
/// @return a row for each of plan.send_indices, in that order: row k is for point send_indices[k]
/// Throws Error as transfer(). Cost: as fetch().
template <class GhostColumns>
[[nodiscard]] auto reply(const GhostPlan& plan, const GhostColumns& ghost_columns, MPI_Comm comm,
                         const TransferLimits& limits = {}, TransferReport* report = nullptr) {
    return detail::moved(detail::Replies{plan}, ghost_columns, comm, limits, report);
}

/// Returns columns of the points with the values of their ghosts on other ranks added, such as
/// forces: the reverse of fetch(). Collective.
///
/// @param plan          of ghosts()
/// @param ghost_columns numbers, as many for each ghost as `columns` have for each point, in the
/// order of fetch()
/// @param columns       numbers of the same types for each of plan.num_points points
/// @param comm          of the plan
/// @param limits        as for transfer()
/// @param report        as for transfer()
/// @return each point's value plus its ghosts' values by ascending rank: the same arguments give
/// the same bits; integers must hold their sums
/// Throws Error as transfer(). Cost: as fetch(); memory for the arriving values.
template <class GhostColumns, class Columns>
[[nodiscard]] auto accumulate(const GhostPlan& plan, const GhostColumns& ghost_columns,
                              const Columns& columns, MPI_Comm comm,
                              const TransferLimits& limits = {}, TransferReport* report = nullptr) {
    return detail::accumulated(plan, ghost_columns, columns, comm, limits, report);
}

}  // namespace rrcb
