#pragma once

#include <rrcb/plan.hpp>

#include <mpi.h>

#include <array>
#include <cstddef>
#include <ranges>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace rrcb {

/// Borrowed view of a column of the points: `components` consecutive values for each point.
///
/// Values must be trivially copyable, such as numbers or structs of numbers. bool is not allowed,
/// because a std::vector of bool is not an array. Ranks compare the kind of the values (integer,
/// floating-point or other), their size, and `components`.
template <class T>
struct Column {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>);

    std::span<const T> values;   ///< of length points * components
    std::size_t components = 1;  ///< number of values of each point, >= 1
};

/// A column whose array a call may write, and resize if the array allows it; see Neighbours. Other
/// calls use it as a Column.
template <std::ranges::contiguous_range Array>
struct WritableColumn : Column<std::ranges::range_value_t<Array>> {
    /// Must outlive the view. `values` is the array as it was when the view was made.
    Array* array;
};

namespace detail {

template <class Array>
concept WritableArray = std::ranges::contiguous_range<Array> && std::is_lvalue_reference_v<Array> &&
    !std::is_const_v<std::remove_reference_t<std::ranges::range_reference_t<Array>>>;

}  // namespace detail

/// Returns a view of a vector or an array of any kind. Not collective.
///
/// @param values     must outlive the view
/// @param components consecutive values of one point, 1 or more
template <std::ranges::contiguous_range Values>
auto column(const Values& values, std::size_t components = 1) {
    return Column<std::ranges::range_value_t<Values>>{values, components};
}
/// Returns a view of an array that is not const, which a call may write. Not collective.
///
/// @param values     as above
/// @param components as above
template <detail::WritableArray Values>
auto column(Values&& values, std::size_t components = 1) {
    using Array = std::remove_reference_t<Values>;
    return WritableColumn<Array>{{values, components}, &values};
}

/// Returns a view unchanged. Not collective.
template <class T>
Column<T> column(const Column<T>& same) {
    return same;
}

/// Returns a view of the array of a writable column, as it is now. Not collective.
template <class Array>
auto column(const WritableColumn<Array>& same) {
    return Column<std::ranges::range_value_t<Array>>{*same.array, same.components};
}

/// Joins several columns, which are then sent in one message: columns(column(positions, 3), masses,
/// numbers).
template <class... Columns>
auto columns(const Columns&... each) {
    return std::tuple(column(each)...);
}

/// Memory and messages of a call on this rank.
struct TransferReport {
    std::size_t peak_bytes = 0;    ///< largest memory in use for messages at the same time
    std::size_t bytes_sent = 0;    ///< bytes of columns that were sent
    std::size_t num_messages = 0;  ///< messages that were sent
};

/// Options of a call that moves columns.
struct TransferOptions {
    /// Maximum memory for messages on each rank, the same on every rank, in addition to the columns
    /// themselves: half of it is for points that leave, half for points that arrive. Each half must
    /// have room for one point with all its columns.
    std::size_t max_bytes = std::size_t{64} << 20;
    TransferReport* report = nullptr;  ///< gets memory and messages; null: is not wanted
};

namespace detail {

/// Kind of a value. Unlike an address or the name of a type, it is the same on every rank of a
/// program.
enum class ValueKind { integer, floating_point, other };

template <class T>
inline constexpr ValueKind kind_of = std::is_integral_v<T>         ? ValueKind::integer
                                     : std::is_floating_point_v<T> ? ValueKind::floating_point
                                                                   : ValueKind::other;

/// A column without its C++ type, and the place of its result.
struct ByteColumn {
    const std::byte* from;
    std::size_t num_values;
    ValueKind kind;
    std::size_t value_bytes;
    std::size_t components;
    void* result;
    std::byte* (*resize)(void* result, std::size_t num_values);
};

/// Throws Error, because an array of fixed size cannot be resized. Never returns.
RRCB_API std::byte* refuse_to_resize(std::size_t from, std::size_t to);

template <class T>
ByteColumn byte_column(const Column<T>& column, std::vector<T>& result) {
    return {reinterpret_cast<const std::byte*>(column.values.data()),
            column.values.size(),
            kind_of<T>,
            sizeof(T),
            column.components,
            &result,
            [](void* vector, std::size_t num_values) {
                auto& values = *static_cast<std::vector<T>*>(vector);
                values.resize(num_values);
                return reinterpret_cast<std::byte*>(values.data());
            }};
}

/// Returns a column whose result is its own array. Its values are those in the array now.
template <class Array>
ByteColumn byte_column(const WritableColumn<Array>& column) {
    using T = std::ranges::range_value_t<Array>;
    return {reinterpret_cast<const std::byte*>(std::ranges::data(*column.array)),
            std::ranges::size(*column.array),
            kind_of<T>,
            sizeof(T),
            column.components,
            column.array,
            [](void* array, std::size_t num_values) {
                auto& values = *static_cast<Array*>(array);
                if constexpr (requires { values.resize(num_values); })
                    values.resize(num_values);
                else if (std::ranges::size(values) != num_values)
                    return refuse_to_resize(std::ranges::size(values), num_values);
                return reinterpret_cast<std::byte*>(std::ranges::data(values));
            }};
}

RRCB_API void move(const Plan& plan, std::span<const ByteColumn> columns,
                   const TransferOptions& options, MPI_Comm comm);

/// Moves columns whose results are their own arrays. Collective.
RRCB_API void move_in_place(const Plan& plan, std::span<const ByteColumn> columns, MPI_Comm comm);

/// Moves columns by a plan for which there is a `move` as above. Collective.
template <class AnyPlan, class... T>
std::tuple<std::vector<T>...> moved(const AnyPlan& plan, const std::tuple<Column<T>...>& columns,
                                    MPI_Comm comm, const TransferOptions& options) {
    std::tuple<std::vector<T>...> results;
    const auto each = [&]<std::size_t... I>(std::index_sequence<I...>) {
        return std::array<ByteColumn, sizeof...(T)>{
            byte_column(std::get<I>(columns), std::get<I>(results))...};
    }
    (std::index_sequence_for<T...>{});
    // This call is not in the lambda, because nvcc 13 does not find a `move` there that is declared
    // later.
    move(plan, each, options, comm);
    return results;
}

template <class AnyPlan, class T>
std::vector<T> moved(const AnyPlan& plan, const Column<T>& column, MPI_Comm comm,
                     const TransferOptions& options) {
    return std::get<0>(moved(plan, std::tuple(column), comm, options));
}

template <class AnyPlan, std::ranges::contiguous_range Values>
auto moved(const AnyPlan& plan, const Values& values, MPI_Comm comm,
           const TransferOptions& options) {
    return moved(plan, column(values), comm, options);
}

}  // namespace detail

/// Moves columns of the points along a plan. Collective.
///
///     auto [new_xyz, new_mass] =
///         rrcb::transfer(moves, rrcb::columns(rrcb::column(xyz, 3), mass), comm);
///
/// @param plan    of the points of this rank
/// @param columns the same in the same order on every rank; empty on a rank without points
/// @param comm    of the plan, or a congruent one
/// @param options memory for messages, and a report
/// @return a tuple of vectors for columns(), otherwise a vector: the points that stay in their
/// order, then those that arrive in that of the import lists; separate calls give the same order
/// Throws the same Error on every rank if columns or limits of one do not fit the plan or the other
/// ranks, or if memory runs out; if a message fails, on its rank only. Cost: as plan(); several
/// messages for a pair of ranks if one would exceed `options.max_bytes`.
template <class Columns>
[[nodiscard]] auto transfer(const Plan& plan, const Columns& columns, MPI_Comm comm,
                            const TransferOptions& options = {}) {
    return detail::moved(plan, columns, comm, options);
}

/// Moves points along a plan within the vectors that contain them. Collective.
///
///     rrcb::transfer_in_place(moves, comm, rrcb::column(xyz, 3), rrcb::column(mass));
///
/// Copies only points that move: the arriving ones are appended in the order of the import lists;
/// then the last points fill the places of those that leave, both in ascending order. All other
/// points keep their indices, which they do not with transfer(). Separate calls give the same
/// order.
/// @param plan    of the points of this rank
/// @param comm    of the plan, or a congruent one
/// @param columns of different vectors, of the same types in the same order on every rank
/// Throws Error as transfer(); the vectors are then unchanged, unless a message fails. Cost: as
/// transfer(), but no time for points that stay, unless a vector grows beyond its capacity.
template <class... Vectors>
void transfer_in_place(const Plan& plan, MPI_Comm comm, const WritableColumn<Vectors>&... columns) {
    const std::array<detail::ByteColumn, sizeof...(Vectors)> each{detail::byte_column(columns)...};
    detail::move_in_place(plan, each, comm);
}

/// Moves points along a plan within several vectors in a vector. Collective; otherwise as above.
///
/// @param plan    of the points of this rank
/// @param comm    of the plan, or a congruent one
/// @param columns a vector of numbers for each column
template <class T>
void transfer_in_place(const Plan& plan, MPI_Comm comm, std::vector<std::vector<T>>& columns) {
    std::vector<detail::ByteColumn> each;
    for (std::vector<T>& values : columns) each.push_back(detail::byte_column(column(values)));
    detail::move_in_place(plan, each, comm);
}

}  // namespace rrcb
