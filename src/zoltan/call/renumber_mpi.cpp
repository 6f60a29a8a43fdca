#include "zoltan/call/renumber_mpi.hpp"

#include <algorithm>
#include <utility>

namespace rrcb::zoltan {

namespace {

bool may_change_numbers(const Parameters& parameters, const Layout& layout) {
    const std::vector<double>& sizes = layout.part_sizes;
    const bool are_equal = std::ranges::adjacent_find(sizes, std::not_equal_to<>()) == sizes.end();
    const PartMap& map = layout.map;
    return parameters.remap != 0 && map.num_parts > 1 && map.has_one_rank_per_part() && are_equal;
}

}  // namespace

Renumbering::Renumbering(const Parameters& parameters, const Layout& layout, bool any_names_parts,
                         const TreeShape& shape, const Communicator& comm, bool is_spread) {
    const PartMap& map = layout.map;
    NumberRule rule{map.num_parts, comm.size()};
    rule.by_rank = map.one_each || !any_names_parts;
    rule.is_spread = is_spread && map.is_even;
    rule.listed = map.listed;
    if (!parameters.paper_domain) rule.shape = shape;
    // A single rank keeps its objects under any numbers.
    const bool matters = comm.size() > 1 || !rule.by_rank;
    if (!matters || !may_change_numbers(parameters, layout)) return;
    buffers_.emplace(rule, comm.rank(), false);
    if (!rule.is_spread) boxes_.resize(map.num_parts);
}

Renumbered Renumbering::run(const Objects& objects, std::span<Part> parts, Participant& self) {
    if (!buffers_) return {};
    PreviousParts previous;
    if (objects.names_parts) previous.emplace(objects.initial_parts, parts.size());
    auto [summary, boxes] = find_numbers(parts, previous, *buffers_, self);
    // A rank without memory has no numbers; the next agreement reports that to the others.
    if (summary.identity || self.failed()) return {};
    std::vector<Part> numbers = std::move(summary.numbers);
    Renumbered result{std::move(summary)};
    result.numbering = boxes_.empty() ? Numbering::of_some(std::move(boxes), std::move(numbers))
                                      : Numbering::of_all(std::move(numbers), std::move(boxes_));
    result.numbering.apply(parts);
    return result;
}

}  // namespace rrcb::zoltan
