#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/detail/step_columns.hpp>
#include <rrcb/ghosts.hpp>
#include <rrcb/transfer.hpp>

#include <mpi.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace rrcb {

/// Distances within which ranks are neighbours, and the ranks of the parts. They must be the same
/// on every rank.
struct NeighbourOptions {
    /// Cutoff of ghosts, in the unit of the coordinates; if points have different ones, the
    /// largest.
    double cutoff = 0;
    /// Distance that a point may move between two calls of migrate(), in the same unit.
    double travel = 0;
    /// Periodic box that contains all points, as GhostOptions::periodic. Wrap positions before each
    /// call.
    std::optional<Box> periodic{};
    /// Ranks of each part, for example after a remap(), if they are not those of ranks_of_part().
    std::optional<std::span<const RankRange>> ranks_of_parts{};
    /// Determines whose radii count, see Needs. Except with Needs::scatter, find_ghosts()
    /// exchanges a message with each neighbour.
    Needs needs = Needs::scatter;
};

/// Entries that ranks have in common, for example nodes of a mesh at the faces of parts.
struct SharedEntries {
    std::vector<RankCount> ranks;  ///< number of entries shared with each neighbour, in ascending
                                   ///< order of ranks
    /// Indices of these entries: for the first rank, then for the second, ... Both ranks of a pair
    /// must list the same entries in the same order.
    /// A rank lists the largest LocalIndex for an entry that it does not hold: it adds nothing to
    /// the sum and does not get it.
    std::vector<LocalIndex> indices;
};

/// Arrays for columns of ghosts, see ghosts_of().
template <class... Arrays>
class GhostArrays {
  public:
    /// Refers to arrays, which must outlive the call. Not collective.
    explicit GhostArrays(Arrays&... arrays) : arrays_(arrays...) {}

  private:
    friend class Neighbours;
    std::tuple<Arrays&...> arrays_;
};

/// Names the arrays for columns of ghosts, in the order of the columns of the points. They are
/// vectors, or arrays of the right size. Not collective.
template <class... Arrays>
GhostArrays<Arrays...> ghosts_of(Arrays&... arrays) {
    return GhostArrays<Arrays...>(arrays...);
}

namespace detail {
struct NeighbourAccess;
}  // namespace detail

/// The ranks near this one, for the exchanges in each step of a simulation. A call sends one
/// message to each neighbour; only the constructor is collective.
///
///     rrcb::Neighbours neighbours(balance.cuts, comm, {.cutoff = r, .travel = t});
///     ...                                                // in each step:
///     neighbours.migrate(column(x, 3), column(v, 3), ids);
///     neighbours.find_ghosts(column(x, 3));
///     neighbours.fetch(rrcb::ghosts_of(ghost_x), column(x, 3));
///     neighbours.accumulate(column(ghost_f, 3), column(f, 3));
///
/// A neighbour is a rank with a part whose distance from a part of this rank is at most max(cutoff,
/// travel). Every rank must make the same calls in the same order. If a call fails on a rank, it
/// also fails on its neighbours, the next call on their neighbours, and so on. All ranks throw its
/// text, at the latest in the next collective call, and none waits for a rank that has failed. If
/// several fail, a rank throws one of their texts. Then make new Neighbours, controllers and plans.
class Neighbours {
  public:
    /// Finds the neighbours. Collective.
    ///
    /// @param cuts    of a balance; they are copied
    /// @param options distances, periodic box, ranks of the parts
    /// @param comm    of the balance, or a congruent one
    /// Throws the same Error on every rank: for distances that are negative or not finite, a
    /// periodic box that ghost_plan() would refuse, options or cuts that differ between ranks,
    /// another communicator, or lack of memory. Cost: a pass over the parts, one pass of counts,
    /// and a reduction.
    RRCB_API Neighbours(const Cuts& cuts, MPI_Comm comm, const NeighbourOptions& options);
    /// Finds the neighbours by the boxes of any balancer. Collective.
    ///
    ///     rrcb::Neighbours neighbours(boxes, 3, comm, {.travel = t});  // a box for each rank
    ///
    /// A point in a closed box of its rank stays there, also on a face. Otherwise it moves to the
    /// first part near this rank whose box contains it. Boxes may thus overlap; a point in none of
    /// them is an error of migrate(), so that no ghost is missed.
    /// @param boxes     of all parts; open sides are +-infinity, a box with lower above upper is
    /// empty. Parts have ranks as described at ranks_of_part(), or NeighbourOptions::ranks_of_parts
    /// @param dimension of the points, 1 to 3
    /// @param comm      of the ranks with points
    /// @param options   as above
    /// Throws Error as above, and for bounds that are NaN. Cost: as above, for a list of the boxes.
    RRCB_API Neighbours(std::span<const Box> boxes, int dimension, MPI_Comm comm,
                        const NeighbourOptions& options);
    /// Frees the memory. Does not communicate.
    RRCB_API ~Neighbours();
    /// Takes over the state of another object, which may then only be destroyed or assigned to. Not
    /// collective.
    RRCB_API Neighbours(Neighbours&&) noexcept;
    /// Takes over the state of another object. Not collective.
    RRCB_API Neighbours& operator=(Neighbours&&) noexcept;

    /// Sends points that have left the parts of this rank to their new ranks, and takes the points
    /// that arrive, in place. Exchanges messages with all neighbours.
    ///
    ///     neighbours.migrate(column(x, 3), column(v, 3), ids);
    ///     neighbours.migrate(Points(particles, &Particle::position), particles);
    ///
    /// Arriving points, in ascending order of ranks, take the places of those that left, and then
    /// places at the end; places left over are filled from the end. All other points keep their
    /// indices. Coincident points that a cut divides stay on their rank.
    /// @param positions column of positions, which moves too, or Points in arrays of `columns`
    /// @param columns   different vectors, or column(vector, components), or a vector of vectors
    /// @return the number of arriving points
    /// Throws Error as described above: for a point in a part of no neighbour, which all arrays
    /// still contain, or columns that differ between ranks. Unless memory or MPI fails, no point is
    /// lost or doubled. Cost: a few comparisons for each point, a look-up for each that has left.
    template <class Positions, class... Columns>
    LocalIndex migrate(Positions&& positions, Columns&&... columns) {
        const auto resizable = []<class Values>(Values&& values) {
            return detail::resizable_column(std::forward<Values>(values));
        };
        if constexpr (std::is_same_v<std::remove_cvref_t<Positions>, Points>)
            return migrate_columns(positions, detail::for_each_column(resizable, columns...));
        else
            return migrate_columns(detail::positions_of(column(positions)),
                                   detail::for_each_column(resizable, positions, columns...));
    }

    /// Finds the points that other ranks need as ghosts, as the function ghost_plan() does. They
    /// are in the lists that the member ghost_plan() returns. Sends no messages, except with
    /// Needs::gather or symmetric.
    ///
    /// Call it on every rank after migrate() and before fetch(). To keep ghosts for several steps,
    /// give radii with a skin, and call neither migrate() nor find_ghosts() until the skin is used
    /// up.
    /// @param positions a column with an entry for each axis, or Points
    /// @param radii     one for each point, at most NeighbourOptions::cutoff; by default all have
    /// that radius
    /// Throws Error on this rank, and on the neighbours in their next exchange: for a point that is
    /// so far outside the parts of this rank that ranks other than neighbours need it, and as
    /// ghost_plan().
    template <class Positions>
    void find_ghosts(const Positions& positions,
                     const std::optional<std::span<const double>>& radii = {}) {
        if constexpr (std::is_same_v<Positions, Points>)
            find_ghosts_of(positions, radii);
        else
            find_ghosts_of(detail::positions_of(column(positions)), radii);
    }

    /// Fetches columns of the ghosts into arrays, which it resizes. Exchanges messages with all
    /// neighbours.
    ///
    ///     neighbours.fetch(rrcb::ghosts_of(ghost_x, ghost_ids), column(x, 3), ids);
    ///
    /// Ghosts are in the order of fetch(plan, ...): in ascending order of ranks. Positions of
    /// images are those of their points until you call apply_shifts(neighbours.ghost_plan(),
    /// ghost_x).
    /// @param ghosts  a different array for each column
    /// @param columns of the points that find_ghosts() got, with the same types on every rank
    /// Throws Error as described above: for columns that do not fit the points or the columns of
    /// other ranks, or if points of this rank have migrated since find_ghosts().
    template <class... Arrays, class... Columns>
    void fetch(const GhostArrays<Arrays...>& ghosts, const Columns&... columns) {
        static_assert(sizeof...(Arrays) == sizeof...(Columns), "give an array for each column");
        const auto each = [&]<std::size_t... I>(std::index_sequence<I...>) {
            return std::array<detail::ByteColumn, sizeof...(Columns)>{
                fetched(std::get<I>(ghosts.arrays_), columns)...};
        }
        (std::index_sequence_for<Arrays...>{});
        fetch_columns(each);
    }

    /// Adds the values of ghosts to those of their points, in place. This is the reverse of
    /// fetch(). Exchanges messages with all neighbours.
    ///
    ///     neighbours.accumulate(column(ghost_f, 3), column(f, 3));
    ///
    /// @param ghosts  one entry, or `components`, for each ghost of the latest fetch(); or
    /// ghosts_of() several such arrays
    /// @param columns writable numbers of the same types for each point
    /// Adds in the same order as accumulate(plan, ...), so that the results are bit-identical.
    /// Throws Error as fetch().
    template <class GhostColumn, class... Columns>
    void accumulate(const GhostColumn& ghosts, Columns&&... columns) {
        static_assert(sizeof...(Columns) == 1, "name several arrays of ghosts with ghosts_of()");
        accumulate_columns(
            std::array{summed(detail::any_column(ghosts), std::forward<Columns>(columns)...)});
    }
    /// Adds several columns in the same way, with one message to each neighbour.
    ///
    ///     neighbours.accumulate(rrcb::ghosts_of(ghost_f, ghost_q), column(f, 3), q);
    ///
    /// @param ghosts  an array for each column
    /// @param columns as above
    template <class... Arrays, class... Columns>
    void accumulate(const GhostArrays<Arrays...>& ghosts, Columns&&... columns) {
        static_assert(sizeof...(Arrays) == sizeof...(Columns), "give a column for each array");
        const auto each = [&]<std::size_t... I>(std::index_sequence<I...>) {
            return std::array{
                summed_as(std::get<I>(ghosts.arrays_), std::forward<Columns>(columns))...};
        }
        (std::index_sequence_for<Arrays...>{});
        accumulate_columns(each);
    }

    /// Replaces shared entries by the sums of their values over all ranks that list them, in place.
    /// Exchanges messages with all neighbours.
    ///
    /// Values are added in ascending order of ranks. If every two ranks that have an entry list it
    /// for each other, all get bit-identical sums. An entry that is 0 in all columns of a rank is
    /// not sent, so lists may contain many entries that only few points reach.
    /// @param shared  lists of entries in common with neighbours
    /// @param columns writable numbers: one entry, or `components`, for each node; or a vector of
    /// vectors
    /// Throws Error as described above, and for ranks that are not neighbours or whose lists differ
    /// in length.
    template <class... Columns>
    void sum(const SharedEntries& shared, Columns&&... columns) {
        const auto summed = []<class Values>(Values&& values) { return summed_alone(values); };
        sum_columns(shared, detail::for_each_column(summed, columns...));
    }

    /// Fails on this rank with a text of yours, as a call that fails: the other ranks throw it,
    /// too. Not collective.
    ///
    ///     if (!is_finite(x)) neighbours.fail("the time step is too long");
    ///
    /// @param text of the Error
    /// Throws Error.
    [[noreturn]] RRCB_API void fail(const std::string& text);

    /// Returns the lists of find_ghosts() with a stamp: `send` and `send_indices`, and
    /// after the first fetch() also `receive` and `shifts`. They are valid until the next call. Not
    /// collective.
    RRCB_API const GhostPlan& ghost_plan() const;

    /// Returns the ranks of the neighbours, ascending. Not collective.
    RRCB_API std::span<const int> ranks() const;

  private:
    friend struct detail::NeighbourAccess;
    struct State;

    // The functions above for columns without their types. When columns migrate, the results are
    // their own arrays; when ghosts are fetched, the results are the arrays of the ghosts; of
    // shared entries only `points` is used.
    RRCB_API LocalIndex migrate_columns(const Points& positions,
                                        std::span<const detail::ByteColumn> columns);
    RRCB_API void find_ghosts_of(const Points& points,
                                 const std::optional<std::span<const double>>& radii);
    RRCB_API void fetch_columns(std::span<const detail::ByteColumn> columns);
    RRCB_API void accumulate_columns(std::span<const detail::SumColumn> columns);
    RRCB_API void sum_columns(const SharedEntries& shared,
                              std::span<const detail::SumColumn> columns);

    template <class Array, class Values>
    static detail::ByteColumn fetched(Array& array, const Values& values) {
        detail::ByteColumn result = detail::any_column(values);
        const detail::ByteColumn ghosts = detail::byte_column(column(array));
        static_assert(std::is_same_v<std::ranges::range_value_t<Array>,
                                     typename decltype(value_of(column(values)))::type>,
                      "ghosts must have the type of the column");
        result.result = ghosts.result;
        result.resize = ghosts.resize;
        return result;
    }
    template <class T>
    static std::type_identity<T> value_of(const Column<T>&);

    template <class Values>
    static detail::SumColumn summed(const detail::ByteColumn& ghosts, Values&& values) {
        using T = typename decltype(value_of(column(values)))::type;
        static_assert(std::is_arithmetic_v<T>, "only numbers can be added");
        return {ghosts, detail::writable_column(std::forward<Values>(values)),
                detail::add_values<T>};
    }
    template <class Array, class Values>
    static detail::SumColumn summed_as(const Array& array, Values&& values) {
        detail::SumColumn sum = summed(detail::any_column(array), std::forward<Values>(values));
        sum.ghosts.components = sum.points.components;
        return sum;
    }
    template <class Values>
    static detail::SumColumn summed_alone(Values&& values) {
        return summed({}, std::forward<Values>(values));
    }

    std::unique_ptr<State> state_;
};

}  // namespace rrcb
