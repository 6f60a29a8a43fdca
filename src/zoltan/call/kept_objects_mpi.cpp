#include "zoltan/call/kept_objects_mpi.hpp"

#include "arithmetic/non_stop.hpp"
#include "arithmetic/vector_clones.hpp"
#include "collective/communicator.hpp"
#include "passes/point_layout.hpp"

#include <rrcb/detail/mix.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

namespace rrcb::zoltan {

namespace {

/// Joins an entry of an object with the entries before it. The high bits, in which alone simple
/// numbers differ, are mixed into the low ones.
std::uint64_t join(std::uint64_t entries, double entry) {
    entries = (entries ^ std::bit_cast<std::uint64_t>(entry)) * 0x9e3779b97f4a7c15U;
    return entries ^ (entries >> 32);
}

template <bool Weighted, class Layout>
RRCB_VECTOR_CLONES std::uint64_t checksum_of(const Layout& x, std::span<const double> weights,
                                             std::span<const Part> parts) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        std::uint64_t entries = static_cast<std::uint64_t>(parts[i]) + 1;
        if constexpr (Weighted) entries = join(entries, weights[i]);
        for (int axis = 0; axis < Layout::dimension; ++axis) entries = join(entries, x(i, axis));
        sum += detail::mix(entries);
    }
    return sum;
}

}  // namespace

std::uint64_t checksum_of(const Points& points, std::span<const Part> parts) {
    return visit_layout(points, [&](const auto& x) {
        return points.weights.empty() ? checksum_of<false>(x, points.weights, parts)
                                      : checksum_of<true>(x, points.weights, parts);
    });
}

std::optional<std::uint64_t> checksum_in_place(const Objects& objects, LastPartition& last,
                                               const KeptObjects& kept, int rank,
                                               std::vector<Part>& parts) {
    const NonStop arithmetic;
    const PartMap& map = last.map();
    if (!map.one_each && !objects.names_parts) return std::nullopt;
    const auto count = static_cast<std::size_t>(objects.count);
    const int* named = objects.initial_parts;
    parts.assign(count, rank);
    if (named != nullptr) std::copy_n(named, count, parts.begin());
    // Cuts can show that an object is not in its part only if they divide no coincident objects.
    const bool ask_cuts = kept.report.details.coincident_cuts == 0 &&
                          last.cuts().dimension == objects.points.dimension;
    if (ask_cuts) last.prepare_look_ups();
    for (std::size_t i = 0; i < count; ++i) {
        const Part part = parts[i];
        if (part < 0 || part >= map.num_parts) return std::nullopt;
        if (!map.ranks_of(part).contains(rank)) return std::nullopt;
        if (ask_cuts && last.part_of(objects.points.position(i).data()) != part)
            return std::nullopt;
    }
    return checksum_of(objects.points, parts);
}

bool add_up(bool moves_here, std::uint64_t& checksum, MPI_Comm comm) {
    std::array<std::uint64_t, 2> sums = {moves_here ? 1U : 0U, checksum};
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_UINT64_T, MPI_SUM, comm),
               "MPI_Allreduce");
    checksum = sums[1];
    return sums[0] != 0;
}

}  // namespace rrcb::zoltan
