#pragma once

#if __cplusplus < 202002L
#error "RRCB needs C++20: add -std=c++20 to the options of the compiler"
#endif

#include <rrcb/export.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ranges>
#include <span>
#include <type_traits>
#include <utility>

namespace rrcb {

using LocalIndex = std::size_t;        ///< counts points of one rank
using GlobalCount = std::int64_t;      ///< counts points over all ranks
using Part = std::int32_t;             ///< number of a part, 0 ... parts - 1
using Vector = std::array<double, 3>;  ///< a position or lengths, an entry per axis

inline constexpr int max_dimension = 3;  ///< most axes of points

/// Axis-aligned closed box. Axes beyond the dimension of the points are ignored.
///
/// The default is the empty box, whose lower end is above the upper one; joining it with another
/// box does not change that box.
struct Box {
    /// Least coordinates.
    Vector lower{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                 std::numeric_limits<double>::infinity()};
    /// Greatest coordinates.
    Vector upper{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                 -std::numeric_limits<double>::infinity()};
};

/// Type of coordinates. Floats count as the doubles of the same values.
enum class ScalarType : std::int32_t {
    float64,  ///< double
    float32   ///< float
};

namespace detail {

template <class T>
concept Scalar = std::same_as<T, double> || std::same_as<T, float>;

template <class Range>
concept FloatRange =
    std::ranges::contiguous_range<Range> && std::same_as < std::ranges::range_value_t<Range>,
float > ;

template <class T>
concept Array = requires(const T& array) {
    array[0];
};

/// A Kokkos::View or a std::mdspan.
template <class View>
concept StridedView = requires(const View& view) {
    view.extent(0);
    view.stride(0);
};

/// A matrix of Eigen in memory.
template <class Matrix>
concept EigenMatrix = requires(const Matrix& matrix) {
    matrix.data();
    matrix.rows();
    matrix.innerStride();
    matrix.outerStride();
};

template <StridedView View>
constexpr std::size_t rank_of() {
    if constexpr (requires { View::rank(); })
        return View::rank();
    else
        return View::Rank;
}

template <StridedView View>
auto data_of(const View& view) {
    // The data_handle() of Kokkos 5 is no pointer.
    if constexpr (requires { view.data(); })
        return view.data();
    else
        return view.data_handle();
}

/// True unless a view of Kokkos is in memory that only a device reads: its mirror is then
/// elsewhere.
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

/// Strides of coordinates that do not fit together. No stride of doubles or floats is odd, so the
/// calls refuse these, on all ranks together.
inline constexpr std::size_t left_over = std::numeric_limits<std::size_t>::max();
inline constexpr std::size_t unequal = left_over - 2;

}  // namespace detail

/// Borrowed view of one rank's points, 1-D to 3-D, as rrcb_points of C.
///
///     const rrcb::Points points(coordinates, 3);                     // xyzxyz...
///     const rrcb::Points points(particles, &Particle::x, &Particle::y);
///
/// Coordinate a of point i is at `axes[a]` + i * `stride` bytes; the axes may be in one array or in
/// several. Floats are treated as doubles of the same values. `weights` is either empty on every
/// rank with points (then every point weighs 1), or has one finite, non-negative weight for each
/// point. If all weights are 0, or all are the same power of two, the result is bit-identical to
/// that without weights; with other equal weights, rounding may move a cut by one point. The arrays
/// must outlive the view. Nothing is copied or checked here: balance() checks on all ranks
/// together, so that no rank fails alone.
struct Points {
    int dimension = 0;                              ///< 1 to 3, on every rank the same
    ScalarType type = ScalarType::float64;          ///< of the coordinates
    LocalIndex count = 0;                           ///< points of this rank
    std::size_t stride = 0;                         ///< from a point to the next, in bytes
    std::array<const void*, max_dimension> axes{};  ///< first coordinate on each axis
    std::span<const double> weights{};              ///< one per point, or none

    Points() = default;

    /// Views points stored one after another.
    ///
    /// @param coordinates   doubles, a multiple of `num_axes` of them
    /// @param num_axes      dimension, 1 to 3
    /// @param point_weights empty, or one for each point
    Points(std::span<const double> coordinates, int num_axes,
           std::span<const double> point_weights = {}) {
        set_interleaved(coordinates.data(), coordinates.size(), num_axes, point_weights);
    }
    /// Views floats stored one after another, in an array of any kind.
    template <detail::FloatRange Floats>
    Points(const Floats& coordinates, int num_axes, std::span<const double> point_weights = {}) {
        set_interleaved(std::ranges::data(coordinates), std::ranges::size(coordinates), num_axes,
                        point_weights);
    }

    /// Views one array per axis.
    ///
    /// @param columns       1 to 3 arrays of the same length
    /// @param point_weights empty, or as long as a column
    explicit Points(std::span<const std::span<const double>> columns,
                    std::span<const double> point_weights = {}) {
        set_columns(columns, point_weights);
    }
    /// Views one array of floats per axis.
    explicit Points(std::span<const std::span<const float>> columns,
                    std::span<const double> point_weights = {}) {
        set_columns(columns, point_weights);
    }

    /// Views coordinates in members of structs, doubles or floats. Set weights afterwards.
    ///
    /// @param structs a vector or an array of any kind
    /// @param first   member for the first axis
    /// @param others  members of the same type for the other axes
    template <std::ranges::contiguous_range Structs, detail::Scalar T, class Struct,
              std::same_as<T Struct::*>... Others>
    Points(const Structs& structs, T Struct::*first, Others... others) {
        using Element = std::ranges::range_value_t<Structs>;
        static_assert(sizeof(Element) % sizeof(T) == 0, "structs must hold whole coordinates");
        static_assert(sizeof...(others) < max_dimension);
        const Element* elements = std::ranges::data(structs);
        const LocalIndex size = std::ranges::size(structs);
        for (T Struct::*const member : {first, others...})
            add_axis(size == 0 ? nullptr : &(elements->*member), size, sizeof(Element) / sizeof(T));
    }

    /// Views positions in one member, an array of 1 to 3 doubles or floats. Set a lower dimension
    /// afterwards to use fewer axes. If positions are structs, set the members of the view instead.
    template <std::ranges::contiguous_range Structs, class Position, class Struct>
    requires(!detail::Scalar<Position>) Points(const Structs& structs, Position Struct::*position) {
        static_assert(detail::Array<Position>,
                      "the member must be an array; set the members of Points for a struct of "
                      "coordinates: dimension, type, count, stride and axes");
        using Element = std::ranges::range_value_t<Structs>;
        using T = std::remove_cvref_t<decltype(std::declval<const Position&>()[0])>;
        static_assert(sizeof(Element) % sizeof(T) == 0, "structs must hold whole coordinates");
        // A vector or a pointer has its numbers elsewhere.
        static_assert(detail::Scalar<T> && sizeof(Position) <= max_dimension * sizeof(T) &&
                          std::is_trivially_destructible_v<Position> &&
                          !std::is_pointer_v<Position>,
                      "the member must be an array of 1 to 3 doubles or floats");
        const Element* elements = std::ranges::data(structs);
        const LocalIndex size = std::ranges::size(structs);
        for (std::size_t a = 0; a < sizeof(Position) / sizeof(T); ++a)
            add_axis(size == 0 ? nullptr : &(elements->*position)[a], size,
                     sizeof(Element) / sizeof(T));
    }

    /// Views a Kokkos::View in memory of the host, or a std::mdspan, of doubles or floats in any
    /// layout with strides.
    ///
    /// @param first  points by axes, or the first axis
    /// @param others one view for each other axis, of the same extent and stride
    template <detail::StridedView First, detail::StridedView... Others>
    explicit Points(const First& first, const Others&... others) {
        static_assert(sizeof...(others) < max_dimension);
        static_assert((detail::host_reads<First>() && ... && detail::host_reads<Others>()),
                      "the host cannot read this view; call rrcb::balance(exec, view, comm) of "
                      "rrcb/experimental/kokkos.hpp, or copy it with "
                      "Kokkos::create_mirror_view_and_copy()");
        const LocalIndex size = first.extent(0);
        if constexpr (detail::rank_of<First>() == 2) {
            static_assert(sizeof...(others) == 0);
            const int num_axes = static_cast<int>(first.extent(1));
            for (int a = 0; a < num_axes; ++a)
                add_axis(detail::data_of(first) + a * first.stride(1), size, first.stride(0));
        } else {
            static_assert(detail::rank_of<First>() == 1);
            const auto add = [&](const auto& view) {
                add_axis(detail::data_of(view), view.extent(0), view.stride(0));
            };
            (add(first), ..., add(others));
        }
    }

    /// Views a matrix of Eigen, or a map of one, with one column for each point.
    ///
    /// @param matrix        1 to 3 rows of doubles or floats
    /// @param point_weights empty, or one for each column
    template <detail::EigenMatrix Matrix>
    explicit Points(const Matrix& matrix, std::span<const double> point_weights = {}) {
        const auto [of_rows, of_columns] =
            Matrix::IsRowMajor ? std::pair(matrix.outerStride(), matrix.innerStride())
                               : std::pair(matrix.innerStride(), matrix.outerStride());
        for (int a = 0; a < static_cast<int>(matrix.rows()); ++a)
            add_axis(matrix.data() + a * of_rows, static_cast<LocalIndex>(matrix.cols()),
                     of_columns);
        weights = point_weights;
    }

    /// Returns the coordinate of point `i` along `axis`. Not collective, as all of these.
    double coordinate(LocalIndex i, int axis) const {
        const void* at =
            static_cast<const std::byte*>(axes[static_cast<std::size_t>(axis)]) + i * stride;
        return type == ScalarType::float32 ? double{*static_cast<const float*>(at)}
                                           : *static_cast<const double*>(at);
    }
    /// Returns the weight of point `i`.
    double weight(LocalIndex i) const { return weights.empty() ? 1.0 : weights[i]; }
    /// Returns the coordinates of point `i`; 0 beyond the dimension.
    Vector position(LocalIndex i) const {
        Vector x{};
        for (int a = 0; a < dimension; ++a) x[static_cast<std::size_t>(a)] = coordinate(i, a);
        return x;
    }

  private:
    template <detail::Scalar T>
    static constexpr ScalarType type_of =
        std::same_as<T, float> ? ScalarType::float32 : ScalarType::float64;

    template <detail::Scalar T>
    void set_interleaved(const T* coordinates, std::size_t size, int num_axes,
                         std::span<const double> point_weights) {
        dimension = num_axes;
        type = type_of<T>;
        weights = point_weights;
        if (num_axes < 1 || num_axes > max_dimension) return;
        const auto axes_of_point = static_cast<std::size_t>(num_axes);
        count = size / axes_of_point;
        stride = size % axes_of_point == 0 ? axes_of_point * sizeof(T) : detail::left_over;
        if (count == 0) return;
        for (std::size_t a = 0; a < axes_of_point; ++a) axes[a] = coordinates + a;
    }

    template <detail::Scalar T>
    void set_columns(std::span<const std::span<const T>> columns,
                     std::span<const double> point_weights) {
        type = type_of<T>;
        weights = point_weights;
        for (const std::span<const T> column : columns) add_axis(column.data(), column.size(), 1);
    }

    /// Adds an axis, whose coordinates are `values` apart.
    template <detail::Scalar T>
    void add_axis(const T* first, LocalIndex size, std::ptrdiff_t values) {
        const std::size_t bytes = size < 2     ? sizeof(T)
                                  : values > 0 ? static_cast<std::size_t>(values) * sizeof(T)
                                               : detail::unequal;
        if (dimension == 0) {
            type = type_of<T>;
            count = size;
            stride = bytes;
        }
        if (size != count || bytes != stride || type != type_of<T>) stride = detail::unequal;
        if (dimension < max_dimension) axes[static_cast<std::size_t>(dimension)] = first;
        ++dimension;
    }
};

/// Returns the smallest box of all points; the empty box if there are none. Not collective.
///
/// The box is NaN on axes with a NaN or infinite coordinate.
RRCB_API Box bounding_box(const Points& points);

}  // namespace rrcb
