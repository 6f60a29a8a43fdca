#include "zoltan/call/lists.hpp"

#include <algorithm>
#include <utility>

namespace rrcb::zoltan {

namespace {

/// Where objects go, and whether that changes their rank or part. Without a callback that names
/// parts, an object is in the part of its rank's number, as in Zoltan.
class Targets {
  public:
    Targets(std::span<const Part> parts, const PartMap& map, const int* initial_parts, int my_rank)
        : parts_(parts), map_(map), initial_parts_(initial_parts), my_rank_(my_rank) {}

    std::size_t count() const { return parts_.size(); }
    int part_of(std::size_t i) const { return parts_[i]; }
    int rank_of(std::size_t i) const {
        return map_.one_each ? parts_[i] : map_.destination(parts_[i], i, my_rank_);
    }
    bool moves(std::size_t i, int rank) const {
        const int initial_part = initial_parts_ == nullptr ? my_rank_ : initial_parts_[i];
        return rank != my_rank_ || parts_[i] != initial_part;
    }

  private:
    std::span<const Part> parts_;
    const PartMap& map_;
    const int* initial_parts_;
    int my_rank_;
};

template <typename T>
void move_entry(T* array, std::size_t width, std::size_t from, std::size_t to) {
    for (std::size_t word = 0; word < width; ++word) {
        array[to * width + word] = array[from * width + word];
    }
}

/// Writes rank and part of all objects; returns true if any moves.
bool list_all(const Targets& to, List& list) {
    bool any_moves = false;
    for (std::size_t i = 0; i < to.count(); ++i) {
        list.ranks[i] = to.rank_of(i);
        list.parts[i] = to.part_of(i);
        any_moves = any_moves || to.moves(i, list.ranks[i]);
    }
    return any_moves;
}

/// Keeps the entries of objects that move, in their order. It works in place, so it cannot fail.
template <class Widths>
void keep_moving(const Targets& to, const Widths& widths, List& list) {
    IdWord* const global_ids = list.global_ids.get();
    IdWord* const local_ids = list.local_ids.get();
    int* const ranks = list.ranks.get();
    int* const parts = list.parts.get();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < to.count(); ++i) {
        const int rank = to.rank_of(i);
        // Written in any case: a later entry takes its place unless it counts.
        move_entry(global_ids, widths.global, i, kept);
        move_entry(local_ids, widths.local, i, kept);
        ranks[kept] = rank;
        parts[kept] = to.part_of(i);
        kept += to.moves(i, rank) ? 1 : 0;
    }
    list.global_ids.shrink(kept * widths.global);
    list.local_ids.shrink(kept * widths.local);
    list.ranks.shrink(kept);
    list.parts.shrink(kept);
    list.count = static_cast<int>(kept);
}

/// A list of all objects, with room for their targets.
List take_arrays(Objects& objects) {
    List list;
    list.count = objects.count;
    list.global_ids = std::move(objects.global_ids);
    list.local_ids = std::move(objects.local_ids);
    list.ranks = std::move(objects.new_ranks);
    list.parts = std::move(objects.new_parts);
    return list;
}

}  // namespace

Exports make_exports(Objects&& objects, const Parameters& parameters,
                     std::span<const Part> new_parts, const PartMap& map, int my_rank) {
    Exports exports;
    List& list = exports.list;
    list = take_arrays(objects);
    const Targets targets(new_parts, map, objects.initial_parts.get(), my_rank);
    if (parameters.return_lists == ReturnLists::parts) {
        exports.moves = list_all(targets, list);
    } else {
        visit_widths(IdWidths(parameters),
                     [&](const auto& widths) { keep_moving(targets, widths, list); });
        exports.moves = list.count > 0;
    }
    return exports;
}

List list_in_place(Objects&& objects, int my_rank) {
    List list = take_arrays(objects);
    const int* parts = objects.initial_parts.get();
    std::fill_n(list.ranks.get(), list.count, my_rank);
    if (parts == nullptr) std::fill_n(list.parts.get(), list.count, my_rank);
    if (parts != nullptr) std::copy_n(parts, list.count, list.parts.get());
    return list;
}

}  // namespace rrcb::zoltan
