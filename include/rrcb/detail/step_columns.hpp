// Columns of points and ghosts without their types, for Neighbours.
#pragma once

#include <rrcb/ghosts.hpp>
#include <rrcb/transfer.hpp>

#include <array>
#include <cstddef>
#include <ranges>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace rrcb {

namespace detail {

/// Stands for an entry that this rank does not hold, in SharedEntries.
inline constexpr LocalIndex no_entry = static_cast<LocalIndex>(-1);

/// Several arrays in a vector, each of which is a column.
template <class Array>
concept ArrayList = std::ranges::range<Array> &&
    requires(std::ranges::range_reference_t<Array> one) {
    one.resize(0);
};

/// Calls make(column) for each column and for each array of a list. Returns the results: an array,
/// or a vector if there is a list.
template <class Make, class... Columns>
auto for_each_column(Make&& make, Columns&&... columns) {
    using Result = std::common_type_t<decltype(make(std::declval<std::vector<double>&>()))>;
    if constexpr ((ArrayList<Columns> || ...)) {
        std::vector<Result> all;
        const auto add = [&]<class Values>(Values&& values) {
            if constexpr (ArrayList<Values>)
                for (auto& one : values) all.push_back(make(one));
            else
                all.push_back(make(std::forward<Values>(values)));
        };
        (add(std::forward<Columns>(columns)), ...);
        return all;
    } else {
        return std::array<Result, sizeof...(Columns)>{make(std::forward<Columns>(columns))...};
    }
}

/// Adds the values of a column to the values of some points.
using AddValues = void(std::span<const LocalIndex> points, std::size_t components,
                       const void* values, void* sums);

/// A column of points, and the column of their ghosts that is added to it. The result of `points`
/// is written.
struct SumColumn {
    ByteColumn ghosts;
    ByteColumn points;
    AddValues* add;
};

template <class T>
void add_values(std::span<const LocalIndex> points, std::size_t components, const void* values,
                void* sums) {
    add_each(points, components, static_cast<const T*>(values), static_cast<T*>(sums));
}

inline Points positions_of(const Points& points) {
    return points;
}

template <Scalar T>
Points positions_of(const Column<T>& column) {
    return Points(column.values, static_cast<int>(column.components));
}

/// Returns a column without its type. Only a writable column has a result.
template <class Values>
ByteColumn any_column(const Values& values) {
    const Column view = column(column(values));
    using T = std::remove_cv_t<typename decltype(view.values)::element_type>;
    return {reinterpret_cast<const std::byte*>(view.values.data()),
            view.values.size(),
            kind_of<T>,
            sizeof(T),
            view.components,
            nullptr,
            nullptr};
}

/// As byte_column(); the array may have a fixed size.
template <class Array>
ByteColumn writable_column(const WritableColumn<Array>& view) {
    return byte_column(view);
}
template <WritableArray Array>
ByteColumn writable_column(Array&& array) {
    return byte_column(column(array));
}

/// As writable_column(), for an array that can be resized.
template <class Array>
ByteColumn resizable_column(const WritableColumn<Array>& view) {
    static_assert(
        requires { view.array->resize(0); }, "give a vector: points come and go");
    return byte_column(view);
}
template <WritableArray Array>
ByteColumn resizable_column(Array&& array) {
    return resizable_column(column(array));
}

}  // namespace detail

}  // namespace rrcb
