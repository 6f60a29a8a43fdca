#include "zoltan/call/renumber_mpi.hpp"

#include <algorithm>
#include <utility>

namespace rrcb::zoltan {

namespace {

bool may_change_numbers(const Parameters& parameters, const Layout& layout) {
    const std::vector<double>& sizes = layout.part_sizes;
    const bool are_equal = std::ranges::adjacent_find(sizes, std::not_equal_to<>()) == sizes.end();
    const PartMap& map = layout.map;
    return parameters.remap != 0 && map.num_parts > 1 && map.num_parts <= most_renumbered &&
           map.has_one_rank_per_part() && are_equal;
}

}  // namespace

Renumbering::Renumbering(const Parameters& parameters, const Layout& layout, bool any_names_parts,
                         const TreeShape& shape, const Communicator& comm) {
    const PartMap& map = layout.map;
    NumberRule rule{map.num_parts, comm.size()};
    rule.by_rank = map.one_each || !any_names_parts;
    rule.listed = map.listed;
    if (!parameters.paper_domain) rule.shape = shape;
    // On a single rank objects remain in place whatever the numbers are.
    const bool matters = comm.size() > 1 || !rule.by_rank;
    if (!matters || !may_change_numbers(parameters, layout)) return;
    buffers_.emplace(rule, comm.rank());
    boxes_.resize(map.num_parts);
}

Renumbered Renumbering::run(const Objects& objects, std::span<Part> parts, Participant& self) {
    if (!buffers_) return {};
    PreviousParts previous;
    if (objects.names_parts) previous.emplace(objects.initial_parts, parts.size());
    Remap summary = find_numbers(parts, previous, *buffers_, self);
    if (summary.identity) return {};
    std::vector<Part> numbers = std::move(summary.numbers);
    Renumbered result{std::move(summary)};
    result.numbering = Numbering(std::move(numbers), std::move(boxes_));
    result.numbering.apply(parts);
    return result;
}

}  // namespace rrcb::zoltan
