#include "lists.hpp"

#include <algorithm>
#include <utility>

namespace rrcb::zoltan {

namespace {

void move_id(ZoltanArray<ZOLTAN_ID_TYPE>& ids, std::size_t width, std::size_t from,
             std::size_t to) {
    if (from != to) std::copy_n(&ids[from * width], width, &ids[to * width]);
}

}  // namespace

Exports make_exports(Objects&& objects, const Parameters& parameters,
                     std::span<const Part> new_parts, const PartMap& map, int my_rank) {
    const auto num_gid = static_cast<std::size_t>(parameters.num_gid_entries);
    const auto num_lid = static_cast<std::size_t>(parameters.num_lid_entries);
    const bool complete = parameters.return_lists == ReturnLists::parts;
    Exports exports;
    List& list = exports.list;
    list.global_ids = std::move(objects.global_ids);
    list.local_ids = std::move(objects.local_ids);
    list.ranks = ZoltanArray<int>(new_parts.size());
    list.parts = ZoltanArray<int>(new_parts.size());
    const int* initial_parts = objects.initial_parts.get();
    std::size_t listed = 0;
    for (std::size_t i = 0; i < new_parts.size(); ++i) {
        const Part part = new_parts[i];
        const int rank = map.destination(part, i, my_rank);
        const int initial_part = initial_parts == nullptr ? my_rank : initial_parts[i];
        const bool moves = rank != my_rank || part != initial_part;
        exports.moves |= moves;
        if (!moves && !complete) continue;
        move_id(list.global_ids, num_gid, i, listed);
        if (num_lid > 0) move_id(list.local_ids, num_lid, i, listed);
        list.ranks[listed] = rank;
        list.parts[listed] = part;
        ++listed;
    }
    list.count = static_cast<int>(listed);
    list.global_ids.shrink(listed * num_gid);
    list.local_ids.shrink(listed * num_lid);
    list.ranks.shrink(listed);
    list.parts.shrink(listed);
    return exports;
}

}  // namespace rrcb::zoltan
