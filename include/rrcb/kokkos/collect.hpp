#pragma once

#include <rrcb/kokkos/tree.hpp>
#include <rrcb/passes.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb::detail {

/// Copies of points on the host: for each its index, part, coordinates, and weight if there is one.
struct Rows {
    int dimension = 0;
    bool has_weights = false;
    std::vector<double> values{};

    std::size_t width() const {
        return static_cast<std::size_t>(dimension) + (has_weights ? 3 : 2);
    }
    std::size_t count() const { return values.size() / width(); }
    Part part(std::size_t k) const { return static_cast<Part>(values[k * width() + 1]); }
    void append_to(Collected& collected) const {
        for (auto row = values.begin(); row != values.end();) {
            collected.original.push_back(static_cast<LocalIndex>(*row));
            row += 2;
            collected.coordinates.insert(collected.coordinates.end(), row, row + dimension);
            row += dimension;
            if (has_weights) collected.weights.push_back(*row++);
        }
    }
};

/// Copies points to the host; takes the marks of those with `parts`, which become no_part. A fence.
template <class Device, class T, class W>
Rows copy_points(Device& device, const Positions<T>& x, const Weights<W>& weights,
                 const typename Device::template Lent<LocalIndex>& indices, Part* parts) {
    Rows rows{x.dimension, weights.values != nullptr, {}};
    const std::size_t width = rows.width();
    rows.values.resize(indices.extent(0) * width);
    const auto view = device.template lend<double>(rows.values.size());
    double* const values = view.data();
    Kokkos::parallel_for(
        "rrcb::copy", device.range(static_cast<std::int64_t>(indices.extent(0))),
        KOKKOS_LAMBDA(const std::int64_t k) {
            const auto i = static_cast<std::int64_t>(indices(k));
            double* row = values + static_cast<std::size_t>(k) * width;
            *row++ = static_cast<double>(i);
            *row++ = parts == nullptr ? no_part : marked(parts[i]);
            if (parts != nullptr) parts[i] = no_part;
            for (int a = 0; a < x.dimension; ++a) *row++ = x(i, a);
            if (weights.values != nullptr) *row = weights(i);
        });
    device.copy_out(view, std::span(rows.values));
    device.fence();
    return rows;
}

/// Lists marked points, of which there are `number`, in ascending order of their indices.
template <class Device>
typename Device::template Lent<LocalIndex> list_marked(Device& device, std::int64_t count,
                                                       std::size_t number, const Part* parts) {
    const auto list = device.template lend<LocalIndex>(number);
    LocalIndex* const indices = list.data();
    Kokkos::parallel_scan(
        "rrcb::list", device.range(count),
        KOKKOS_LAMBDA(const std::int64_t i, std::int64_t& before, const bool is_final) {
            if (parts[i] >= no_part) return;
            if (is_final) indices[before] = static_cast<LocalIndex>(i);
            ++before;
        });
    return list;
}

/// Returns the box of the points of each part. A fence.
template <class Device, class T>
std::vector<Box> boxes_of_parts(Device& device, const Positions<T>& x, const Part* parts,
                                int num_parts) {
    std::vector<Box> boxes(static_cast<std::size_t>(num_parts));
    static_assert(sizeof(Box) == 2 * max_dimension * sizeof(double));
    const std::span bounds(reinterpret_cast<double*>(boxes.data()),
                           2 * max_dimension * boxes.size());
    const auto view = device.copy_in(bounds);
    double* const on_device = view.data();
    Kokkos::parallel_for(
        "rrcb::boxes", device.range(x.count), KOKKOS_LAMBDA(const std::int64_t i) {
            if (parts[i] < 0) return;
            double* const lower = on_device + std::int64_t{parts[i]} * 2 * max_dimension;
            double* const upper = lower + max_dimension;
            for (int a = 0; a < x.dimension; ++a) {
                const double value = x(i, a);
                // Most points need no atomic operation; an old bound costs one.
                if (value < *static_cast<volatile double*>(lower + a))
                    Kokkos::atomic_fetch_min(lower + a, value);
                if (value > *static_cast<volatile double*>(upper + a))
                    Kokkos::atomic_fetch_max(upper + a, value);
            }
        });
    device.copy_out(view, bounds);
    device.fence();
    return boxes;
}

}  // namespace rrcb::detail
