#include "zoltan/call/lists.hpp"

#include <algorithm>

namespace rrcb::zoltan {

namespace {

/// Writes those indices below `count` that move. Returns their number.
template <class IsMoving>
int select(int count, const IsMoving& is_moving, int* indices) {
    int num_moving = 0;
    for (int i = 0; i < count; ++i) {
        // Written in any case; the next index overwrites it unless this one moves.
        indices[num_moving] = i;
        num_moving += is_moving(static_cast<std::size_t>(i)) ? 1 : 0;
    }
    return num_moving;
}

void copy_entry(const IdWord* from, std::size_t i, std::size_t width, IdWord* to, std::size_t k) {
    for (std::size_t word = 0; word < width; ++word) to[k * width + word] = from[i * width + word];
}

}  // namespace

template <class Visit>
auto Moves::visit_ranks(Visit&& visit) const {
    const Part* const parts = parts_.data();
    if (map_.one_each) return visit([=](std::size_t i) { return parts[i]; });
    if (map_.has_one_rank_per_part() && !map_.listed.empty()) {
        const RankRange* const ranks = map_.listed.data();
        return visit([=](std::size_t i) { return ranks[parts[i]].first_rank; });
    }
    return visit([=, this](std::size_t i) { return map_.destination(parts[i], i, my_rank_); });
}

Moves::Moves(Objects& objects, std::span<const Part> parts, const PartMap& map, int my_rank)
    : objects_(objects), parts_(parts), map_(map), my_rank_(my_rank) {
    if (objects.moving == nullptr) return;
    const int* const named = objects.initial_parts;
    count_ = visit_ranks([&](const auto& rank_of) {
        // Has no branch, because it would be mispredicted for objects in any order.
        const auto is_moving = [=](std::size_t i) {
            const int before = named == nullptr ? my_rank : named[i];
            return ((rank_of(i) != my_rank ? 1 : 0) | (parts[i] != before ? 1 : 0)) != 0;
        };
        return select(objects.count, is_moving, objects.moving);
    });
}

template <class Widths, class RankOf>
void Moves::write_by(const Widths& widths, const RankOf& rank_of, List& list) const {
    // These copies let the compiler assume that writes do not change them.
    IdWord* const global_ids = list.global_ids.get();
    IdWord* const local_ids = list.local_ids.get();
    int* const ranks = list.ranks.get();
    int* const parts = list.parts.get();
    const IdWord* const from_global = objects_.global_ids;
    const IdWord* const from_local = objects_.local_ids;
    const int* const moving = objects_.moving;
    const Part* const from = parts_.data();
    for (std::size_t k = 0; k < static_cast<std::size_t>(count_); ++k) {
        const auto i = static_cast<std::size_t>(moving[k]);
        copy_entry(from_global, i, widths.global, global_ids, k);
        copy_entry(from_local, i, widths.local, local_ids, k);
        ranks[k] = rank_of(i);
        parts[k] = from[i];
    }
}

void Moves::write(const IdWidths& widths, List& list) const {
    visit_widths(widths, [&](const auto& known) {
        visit_ranks([&](const auto& rank_of) { write_by(known, rank_of, list); });
    });
    if (list.count == count_) return;
    const auto size = static_cast<std::size_t>(count_);
    list.count = count_;
    shrink(list.global_ids, size * widths.global);
    shrink(list.local_ids, size * widths.local);
    shrink(list.ranks, size);
    shrink(list.parts, size);
}

List Moves::list_all() const {
    List list = take_room();
    visit_ranks([&](const auto& rank_of) {
        for (std::size_t i = 0; i < parts_.size(); ++i) list.ranks[i] = rank_of(i);
    });
    std::ranges::copy(parts_, list.parts.get());
    return list;
}

List list_in_place(Objects&& objects, int my_rank) {
    List list = std::move(objects.room);
    const int* parts = objects.initial_parts;
    std::fill_n(list.ranks.get(), list.count, my_rank);
    if (parts == nullptr) std::fill_n(list.parts.get(), list.count, my_rank);
    if (parts != nullptr) std::copy_n(parts, list.count, list.parts.get());
    return list;
}

}  // namespace rrcb::zoltan
