#include "part_map.hpp"

#include "failure.hpp"

#include <zoltan_types.h>

#include <algorithm>
#include <string>

namespace rrcb::zoltan {

PartMap even_part_map(int num_parts, int num_ranks) {
    PartMap map;
    map.one_each = num_parts == num_ranks;
    map.ranks.reserve(static_cast<std::size_t>(num_parts));
    for (int part = 0; part < num_parts; ++part)
        map.ranks.push_back(ranks_of_part(part, num_parts, num_ranks));
    return map;
}

PartMap local_part_map(std::span<const int> local_parts, int num_global_parts) {
    int asked = 0;
    int num_free_ranks = 0;
    for (const int parts : local_parts) {
        asked += std::max(parts, 0);
        num_free_ranks += parts < 0 ? 1 : 0;
    }
    const int total = num_global_parts < 0 ? asked : num_global_parts;
    if (total == 0) throw Failure(ZOLTAN_FATAL, "Zero parts requested");
    if (asked > total || (asked < total && num_free_ranks == 0)) {
        throw Failure(ZOLTAN_FATAL, "Sum of NUM_LOCAL_PARTS " + std::to_string(asked) +
                                        (asked > total ? " > " : " < ") + "NUM_GLOBAL_PARTS " +
                                        std::to_string(total));
    }
    PartMap map;
    map.one_each = false;
    int rank = 0;
    int free_ranks_left = num_free_ranks;
    for (const int parts : local_parts) {
        const int rest = total - asked;
        const int extra = parts < 0 && free_ranks_left-- <= rest % num_free_ranks ? 1 : 0;
        const int here = parts < 0 ? rest / num_free_ranks + extra : parts;
        map.ranks.insert(map.ranks.end(), static_cast<std::size_t>(here), RankRange{rank, 1});
        ++rank;
    }
    return map;
}

int first_part_of(const PartMap& map, int rank) {
    const auto holds = [rank](const RankRange& range) {
        return rank >= range.first && rank < range.first + range.count;
    };
    const auto found = std::ranges::find_if(map.ranks, holds);
    return found == map.ranks.end() ? -1 : static_cast<int>(found - map.ranks.begin());
}

}  // namespace rrcb::zoltan
