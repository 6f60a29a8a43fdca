#include "zoltan/call/renumber_mpi.hpp"

#include "collective/agreement_mpi.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace rrcb::zoltan {

namespace {

/// Whether objects are to keep their part, not only their rank.
bool by_part(const Layout& layout, const Objects& objects) {
    return !layout.map.one_each && objects.names_parts;
}

bool may_change_numbers(const Parameters& parameters, const Layout& layout) {
    const auto are_equal = [](const std::vector<double>& sizes) {
        return std::ranges::adjacent_find(sizes, std::not_equal_to<>()) == sizes.end();
    };
    const auto on_one_rank = [](const RankRange& range) { return range.count == 1; };
    return parameters.remap != 0 && layout.map.num_parts() > 1 &&
           std::ranges::all_of(layout.map.ranks, on_one_rank) && are_equal(layout.part_sizes) &&
           std::ranges::all_of(layout.further_sizes, are_equal);
}

}  // namespace

Renumbering::Renumbering(const Parameters& parameters, const Layout& layout, const Objects& objects,
                         const Communicator& comm) {
    const int num_parts = layout.map.num_parts();
    unchanged_.numbers.resize(static_cast<std::size_t>(num_parts));
    std::iota(unchanged_.numbers.begin(), unchanged_.numbers.end(), 0);
    // A single rank keeps its objects under any numbers.
    const bool matters = comm.size() > 1 || by_part(layout, objects);
    if (matters && may_change_numbers(parameters, layout))
        room_.emplace(num_parts, comm.size(), comm.rank() == root);
}

Remap Renumbering::run(const Layout& layout, const Objects& objects, std::span<Part> parts,
                       Participant& self) {
    if (!room_) return std::move(unchanged_);
    PreviousParts previous;
    if (by_part(layout, objects)) previous.emplace(objects.initial_parts.get(), parts.size());
    Remap result = remap(parts, previous, layout.map.ranks, *room_, self);
    if (result.identity) return result;
    for (Part& part : parts) part = result.numbers[static_cast<std::size_t>(part)];
    return result;
}

}  // namespace rrcb::zoltan
