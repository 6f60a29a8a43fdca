#include "zoltan/call/rest.hpp"

#include "refinement/mix.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rrcb::zoltan {

namespace {

std::uint64_t join(std::uint64_t sum, std::uint64_t bits) {
    return mix(sum + 0x9e3779b97f4a7c15U + bits);
}

bool is_finite(const Vector& position) {
    return std::ranges::all_of(position, [](double x) { return std::isfinite(x); });
}

}  // namespace

void add_checksums(const Parameters& parameters, const Workspace& workspace, const Points& points,
                   bool with_positions, std::span<const Part> parts,
                   std::span<std::uint64_t> checksums) {
    const auto stride = static_cast<std::size_t>(parameters.weight_dimension);
    const float* weights = workspace.callback_weights.data();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        std::uint64_t sum = 1;
        for (std::size_t k = 0; k < stride; ++k)
            sum = join(sum, std::bit_cast<std::uint32_t>(weights[i * stride + k]));
        for (int axis = 0; with_positions && axis < points.dimension; ++axis)
            sum = join(sum, std::bit_cast<std::uint64_t>(points.coordinate(i, axis)));
        checksums[static_cast<std::size_t>(parts[i])] += sum;
    }
}

bool are_in_own_part(const Objects& objects, const PartMap& map, int rank) {
    if (!map.one_each) return false;
    const int* named = objects.initial_parts.get();
    if (named == nullptr) return true;
    return std::all_of(named, named + objects.count, [&](int part) { return part == rank; });
}

bool is_at_rest(const Rest& rest, const KeptPartition& kept, const Parameters& parameters,
                const Workspace& workspace, const Objects& objects, int rank) {
    const PartMap& map = kept.map();
    if (!map.one_each && !objects.names_parts) return false;
    if (rest.dimension != objects.points.dimension) return false;
    const auto is_here = [&](Part part) {
        const RankRange& range = map.ranks[static_cast<std::size_t>(part)];
        return range.first_rank == rank && range.count == 1;
    };
    const bool with_positions = Rest::needs_positions(rest.report);
    const int* named = objects.initial_parts.get();
    std::vector<Part> parts(static_cast<std::size_t>(objects.count), rank);
    if (named != nullptr) std::copy_n(named, parts.size(), parts.begin());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i] < 0 || parts[i] >= map.num_parts() || !is_here(parts[i])) return false;
        const Vector position = objects.points.position(i);
        if (!is_finite(position)) return false;
        if (!with_positions && kept.part_of(position.data()) != parts[i]) return false;
    }
    std::vector<std::uint64_t> checksums(rest.checksums.size(), 0);
    add_checksums(parameters, workspace, objects.points, with_positions, parts, checksums);
    for (Part part = 0; part < map.num_parts(); ++part) {
        const auto index = static_cast<std::size_t>(part);
        if (is_here(part) && checksums[index] != rest.checksums[index]) return false;
    }
    return true;
}

}  // namespace rrcb::zoltan
