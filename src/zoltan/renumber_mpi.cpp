#include "renumber_mpi.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace rrcb::zoltan {

namespace {

bool may_change_numbers(const Parameters& parameters, const Layout& layout) {
    const std::vector<double>& sizes = layout.part_sizes;
    const auto on_one_rank = [](const RankRange& range) { return range.count == 1; };
    return parameters.remap != 0 && layout.map.num_parts() > 1 &&
           std::ranges::all_of(layout.map.ranks, on_one_rank) &&
           std::ranges::adjacent_find(sizes, std::not_equal_to<>()) == sizes.end();
}

Remap unchanged(int num_parts) {
    Remap remap;
    remap.numbers.resize(static_cast<std::size_t>(num_parts));
    std::iota(remap.numbers.begin(), remap.numbers.end(), 0);
    return remap;
}

Remap find_numbers(const PartMap& map, const Objects& objects, std::span<const Part> parts,
                   MPI_Comm comm) {
    if (map.one_each || !objects.names_parts) return remap(parts, map.ranks, comm);
    return remap(parts, {objects.initial_parts.get(), parts.size()}, map.ranks, comm);
}

}  // namespace

Remap renumber(const Parameters& parameters, const Layout& layout, const Objects& objects,
               std::span<Part> parts, MPI_Comm comm) {
    if (!may_change_numbers(parameters, layout)) return unchanged(layout.map.num_parts());
    Remap result = find_numbers(layout.map, objects, parts, comm);
    if (result.identity) return result;
    for (Part& part : parts) part = result.numbers[static_cast<std::size_t>(part)];
    return result;
}

}  // namespace rrcb::zoltan
