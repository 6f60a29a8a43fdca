#include "zoltan/call/renumber_mpi.hpp"

#include "collective/agreement_mpi.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace rrcb::zoltan {

namespace {

/// Whether objects are to keep their part, not only their rank.
bool by_part(const Layout& layout, const Objects& objects) {
    return !layout.map.one_each && objects.names_parts;
}

bool may_change_numbers(const Parameters& parameters, const Layout& layout) {
    const std::vector<double>& sizes = layout.part_sizes;
    const bool are_equal = std::ranges::adjacent_find(sizes, std::not_equal_to<>()) == sizes.end();
    // Those that are listed by what ranks ask for have one each.
    const PartMap& map = layout.map;
    const bool are_on_one_rank = !map.is_even || map.num_parts >= map.num_ranks;
    return parameters.remap != 0 && map.num_parts > 1 && are_on_one_rank && are_equal;
}

}  // namespace

Renumbering::Renumbering(const Parameters& parameters, const Layout& layout, const Objects& objects,
                         const Communicator& comm, bool is_spread) {
    const int num_parts = layout.map.num_parts;
    // A single rank keeps its objects under any numbers.
    const bool matters = comm.size() > 1 || by_part(layout, objects);
    if (!matters || !may_change_numbers(parameters, layout)) return;
    if (is_spread && layout.map.is_even) {
        spread_room_.emplace(num_parts, comm.get());
        return;
    }
    room_ = Room{RemapBuffers(num_parts, comm.size(), comm.rank() == root), {}, {}};
    room_->boxes.resize(static_cast<std::size_t>(num_parts));
    for (Part part = 0; part < num_parts; ++part) room_->ranks.push_back(layout.map.ranks_of(part));
}

Renumbered Renumbering::run(const Layout& layout, const Objects& objects, std::span<Part> parts,
                            ButterflyMessages& messages, Participant& self) {
    if (!room_ && !spread_room_) return {};
    PreviousParts previous;
    if (by_part(layout, objects)) previous.emplace(objects.initial_parts.get(), parts.size());
    if (spread_room_) return run_spread(layout, previous, parts, messages, self);
    Remap result = remap(parts, previous, room_->ranks, room_->buffers, self);
    if (result.identity) return {};
    for (Part& part : parts) part = result.numbers[static_cast<std::size_t>(part)];
    std::vector<Part> numbers = std::move(result.numbers);
    return {std::move(result), Numbering::of_all(std::move(numbers), std::move(room_->boxes))};
}

Renumbered Renumbering::run_spread(const Layout& layout, const PreviousParts& previous,
                                   std::span<Part> parts, ButterflyMessages& messages,
                                   Participant& self) {
    SpreadRemap result = remap_spread(parts, layout.map.one_each ? Origins::ranks : Origins::parts,
                                      previous, *spread_room_, messages, self);
    if (result.summary.identity) return {};
    Renumbered renumbered{std::move(result.summary)};
    self.attempt([&] {
        std::vector<Part> boxes;
        std::vector<Part> numbers;
        for (const auto& [box, number] : result.numbers) {
            boxes.push_back(box);
            numbers.push_back(number);
        }
        renumbered.numbering = Numbering::of_some(std::move(boxes), std::move(numbers));
        // A failure elsewhere, of which no rank has heard yet, may have lost one.
        for (Part& part : parts)
            if (const Part number = renumbered.numbering.number_of(part); number != no_part)
                part = number;
    });
    return renumbered;
}

}  // namespace rrcb::zoltan
