#include "zoltan/handle/part_map.hpp"

#include "zoltan/real/zoltan_error.hpp"

#include <zoltan_types.h>

#include <algorithm>
#include <string>

namespace rrcb::zoltan {

namespace {

struct Asked {
    int parts = 0;
    int free_ranks = 0;  ///< which leave it open
};

Asked asked_by(std::span<const int> local_parts) {
    Asked asked;
    for (const int parts : local_parts) {
        asked.parts += std::max(parts, 0);
        asked.free_ranks += parts < 0 ? 1 : 0;
    }
    return asked;
}

}  // namespace

PartMap even_part_map(int num_parts, int num_ranks) {
    PartMap map;
    map.one_each = num_parts == num_ranks;
    map.ranks.reserve(static_cast<std::size_t>(num_parts));
    for (int part = 0; part < num_parts; ++part)
        map.ranks.push_back(ranks_of_part(part, num_parts, num_ranks));
    return map;
}

int num_parts_of(std::span<const int> local_parts, int num_global_parts) {
    const Asked asked = asked_by(local_parts);
    const int total = num_global_parts < 0 ? asked.parts : num_global_parts;
    if (total == 0) throw ZoltanError(ZOLTAN_FATAL, "Zero parts requested");
    if (asked.parts > total || (asked.parts < total && asked.free_ranks == 0)) {
        throw ZoltanError(ZOLTAN_FATAL, "Sum of NUM_LOCAL_PARTS " + std::to_string(asked.parts) +
                                            (asked.parts > total ? " > " : " < ") +
                                            "NUM_GLOBAL_PARTS " + std::to_string(total));
    }
    return total;
}

PartMap local_part_map(std::span<const int> local_parts, int num_parts) {
    const Asked asked = asked_by(local_parts);
    const int rest = num_parts - asked.parts;
    PartMap map;
    map.one_each = false;
    int rank = 0;
    int free_ranks_left = asked.free_ranks;
    for (const int parts : local_parts) {
        const int extra = parts < 0 && free_ranks_left-- <= rest % asked.free_ranks ? 1 : 0;
        const int here = parts < 0 ? rest / asked.free_ranks + extra : parts;
        map.ranks.insert(map.ranks.end(), static_cast<std::size_t>(here), RankRange{rank, 1});
        ++rank;
    }
    return map;
}

int first_part_of(const PartMap& map, int rank) {
    const auto holds = [rank](const RankRange& range) {
        return rank >= range.first_rank && rank < range.first_rank + range.count;
    };
    const auto found = std::ranges::find_if(map.ranks, holds);
    return found == map.ranks.end() ? -1 : static_cast<int>(found - map.ranks.begin());
}

}  // namespace rrcb::zoltan
