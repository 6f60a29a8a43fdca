#pragma once

#include <rrcb/points.hpp>

#include <concepts>
#include <cstddef>
#include <ranges>
#include <type_traits>
#include <utility>

namespace rrcb {

namespace detail {

template <class T>
concept Scalar = std::same_as<T, double> || std::same_as<T, float>;

template <class T>
concept Array = requires(const T& array) {
    array[0];
};

template <class View>
concept StridedView = requires(const View& view) {
    view.extent(0);
    view.stride(0);
};

/// Sets one axis. Does not throw, because balance() refuses a stride of 0 on all ranks together.
template <Scalar T>
void set_axis(Points& points, int axis, const T* first, LocalIndex count, std::ptrdiff_t stride) {
    if (axis == 0) points.count = count;
    if (axis == 0) points.stride = stride > 0 ? static_cast<std::size_t>(stride) : 0;
    if (points.stride != static_cast<std::size_t>(stride)) points.stride = 0;
    const std::size_t size = count == 0 ? 0 : (count - 1) * points.stride + 1;
    if constexpr (std::same_as<T, double>)
        points.axes[axis] = {first, size};
    else
        points.float_axes[axis] = {first, size};
}

template <StridedView View>
constexpr std::size_t rank_of() {
    if constexpr (requires { View::rank(); })
        return View::rank();
    else
        return View::Rank;
}

template <StridedView View>
auto data_of(const View& view) {
    // The data_handle() of Kokkos 5 is not a pointer, so data() comes first.
    if constexpr (requires { view.data(); })
        return view.data();
    else
        return view.data_handle();
}

/// True unless a view of Kokkos is in memory that only a device reads; such a view has its host
/// mirror elsewhere.
template <class View>
constexpr bool host_reads() {
    if constexpr (requires { typename View::host_mirror_type; })
        return std::same_as<typename View::memory_space,
                            typename View::host_mirror_type::memory_space>;
    else if constexpr (requires { typename View::HostMirror; })
        return std::same_as<typename View::memory_space, typename View::HostMirror::memory_space>;
    else
        return true;
}

}  // namespace detail

/// Returns a view of coordinates in members of structs: member_points(particles, &Particle::x,
/// &Particle::y). Not collective. You can set weights in the result.
///
/// @param structs a vector or an array of any kind
/// @param first   member for the first axis, a double or a float
/// @param others  members of the same type for the other axes
template <std::ranges::contiguous_range Structs, detail::Scalar T, class Struct,
          std::same_as<T Struct::*>... Others>
Points member_points(const Structs& structs, T Struct::*first, Others... others) {
    using Element = std::ranges::range_value_t<Structs>;
    static_assert(sizeof(Element) % sizeof(T) == 0, "structs must hold whole coordinates");
    static_assert(sizeof...(others) < max_dimension);
    Points points{.dimension = 1 + static_cast<int>(sizeof...(others))};
    const Element* elements = std::ranges::data(structs);
    const LocalIndex count = std::ranges::size(structs);
    int axis = 0;
    for (T Struct::*const member : {first, others...})
        detail::set_axis(points, axis++, count == 0 ? nullptr : &(elements->*member), count,
                         sizeof(Element) / sizeof(T));
    return points;
}

/// Returns a view of positions in one member, which is an array: member_points(particles,
/// &Particle::position). Not collective. To use fewer axes, set a lower dimension in the result.
///
/// @param structs  a vector or an array of any kind
/// @param position member, an array of 1 to 3 doubles or floats; if it is a struct, fill Points
template <std::ranges::contiguous_range Structs, detail::Array Position, class Struct>
Points member_points(const Structs& structs, Position Struct::*position) {
    using Element = std::ranges::range_value_t<Structs>;
    using T = std::remove_cvref_t<decltype(std::declval<const Position&>()[0])>;
    static_assert(sizeof(Element) % sizeof(T) == 0, "structs must hold whole coordinates");
    // A vector or a pointer has its numbers in other memory.
    static_assert(detail::Scalar<T> && sizeof(Position) <= max_dimension * sizeof(T) &&
                      std::is_trivially_destructible_v<Position> && !std::is_pointer_v<Position>,
                  "the member must be an array of 1 to 3 doubles or floats");
    Points points{.dimension = static_cast<int>(sizeof(Position) / sizeof(T))};
    const Element* elements = std::ranges::data(structs);
    const LocalIndex count = std::ranges::size(structs);
    for (int axis = 0; axis < points.dimension; ++axis)
        detail::set_axis(points, axis, count == 0 ? nullptr : &(elements->*position)[axis], count,
                         sizeof(Element) / sizeof(T));
    return points;
}

/// Explains at compile time what to do with positions that are not arrays.
template <std::ranges::contiguous_range Structs, class Position, class Struct>
requires(!detail::Scalar<Position> && !detail::Array<Position>) Points
    member_points(const Structs&, Position Struct::*) {
    static_assert(detail::Array<Position>,
                  "the member must be an array; fill Points for a struct of coordinates: "
                  "dimension, count, stride, and axes or float_axes");
    return {};
}

/// Returns a view of a Kokkos::View in the memory of the host, or of a std::mdspan, with any
/// strided layout. Not collective. The elements must be doubles or floats.
///
/// @param first  points by axes, or the first axis
/// @param others one view for each other axis, of the same extent and stride
template <detail::StridedView First, detail::StridedView... Others>
Points view_points(const First& first, const Others&... others) {
    static_assert(sizeof...(others) < max_dimension);
    static_assert(
        (detail::host_reads<First>() && ... && detail::host_reads<Others>()),
        "the host cannot read this view; call rrcb::balance(exec, view, options, comm) of "
        "rrcb/kokkos.hpp, or copy it with Kokkos::create_mirror_view_and_copy()");
    const LocalIndex count = first.extent(0);
    const auto stride = [&](const auto& view) {
        return count > 1 ? static_cast<std::ptrdiff_t>(view.stride(0)) : 1;
    };
    Points points;
    if constexpr (detail::rank_of<First>() == 2) {
        static_assert(sizeof...(others) == 0);
        points.dimension = static_cast<int>(first.extent(1));
        for (int axis = 0; axis < points.dimension && axis < max_dimension; ++axis)
            detail::set_axis(points, axis, detail::data_of(first) + axis * first.stride(1), count,
                             stride(first));
    } else {
        static_assert(detail::rank_of<First>() == 1);
        const auto add = [&](const auto& view) {
            const LocalIndex length = view.extent(0);
            detail::set_axis(points, points.dimension++, detail::data_of(view), length,
                             length == count ? stride(view) : 0);
        };
        (add(first), ..., add(others));
    }
    return points;
}

}  // namespace rrcb
