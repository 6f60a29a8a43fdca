#include "zoltan/call/lists.hpp"

#include <algorithm>
#include <utility>

namespace rrcb::zoltan {

namespace {

/// Writes rank and part that every object goes to.
void write_targets(std::span<const Part> new_parts, const PartMap& map, int my_rank, List& list) {
    int* ranks = list.ranks.get();
    std::ranges::copy(new_parts, list.parts.get());
    if (map.one_each) {
        std::ranges::copy(new_parts, ranks);
        return;
    }
    for (std::size_t i = 0; i < new_parts.size(); ++i) {
        ranks[i] = map.destination(new_parts[i], i, my_rank);
    }
}

/// Test whether an object changes its rank or part. Without a callback that names parts, an object
/// is in the part of its rank's number, as in Zoltan.
class Moves {
  public:
    Moves(const List& list, const int* initial_parts, int my_rank)
        : ranks_(list.ranks.get()),
          parts_(list.parts.get()),
          initial_parts_(initial_parts),
          my_rank_(my_rank) {}

    bool operator()(std::size_t i) const {
        const int initial_part = initial_parts_ == nullptr ? my_rank_ : initial_parts_[i];
        return ranks_[i] != my_rank_ || parts_[i] != initial_part;
    }

  private:
    const int* ranks_;
    const int* parts_;
    const int* initial_parts_;
    int my_rank_;
};

template <typename T>
void move_entry(T* array, std::size_t width, std::size_t from, std::size_t to) {
    for (std::size_t word = 0; word < width; ++word) {
        array[to * width + word] = array[from * width + word];
    }
}

/// Keeps the entries of objects that move, in their order. It works in place, so it cannot fail.
void keep_moving(const Moves& moves, const IdWidths& widths, List& list) {
    std::size_t kept = 0;
    for (int i = 0; i < list.count; ++i) {
        if (!moves(i)) continue;
        move_entry(list.global_ids.get(), widths.global, i, kept);
        move_entry(list.local_ids.get(), widths.local, i, kept);
        move_entry(list.ranks.get(), 1, i, kept);
        move_entry(list.parts.get(), 1, i, kept);
        ++kept;
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

bool any_moves(const Moves& moves, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        if (moves(i)) return true;
    }
    return false;
}

}  // namespace

Exports make_exports(Objects&& objects, const Parameters& parameters,
                     std::span<const Part> new_parts, const PartMap& map, int my_rank) {
    Exports exports;
    List& list = exports.list;
    list = take_arrays(objects);
    write_targets(new_parts, map, my_rank, list);
    const Moves moves(list, objects.initial_parts.get(), my_rank);
    if (parameters.return_lists == ReturnLists::parts) {
        exports.moves = any_moves(moves, new_parts.size());
    } else {
        keep_moving(moves, IdWidths(parameters), list);
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
