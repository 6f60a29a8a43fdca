#include "zoltan/handle/part_map.hpp"

#include "zoltan/real/message.hpp"

#include <zoltan_types.h>

#include <algorithm>
#include <string>

namespace rrcb::zoltan {

namespace {

/// Up to this number of parts a list of their ranks is kept, because it is faster than a formula.
constexpr int most_listed = 4096;

struct Asked {
    int parts = 0;
    int free_ranks = 0;  ///< number of ranks that do not set it
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

PartRange PartMap::parts_on(int rank) const {
    if (is_even) return rrcb::parts_on(rank, num_parts, num_ranks);
    return parts_from(rank, listed);
}

PartMap even_part_map(int num_parts, int num_ranks) {
    PartMap map{num_parts, num_ranks, num_parts == num_ranks};
    if (map.one_each || num_parts > most_listed) return map;
    map.listed.reserve(num_parts);
    if (num_parts > num_ranks) {
        for (int rank = 0; rank < num_ranks; ++rank)
            map.listed.resize(map.parts_on(rank).end, RankRange{rank, 1});
        return map;
    }
    for (int part = 0; part < num_parts; ++part)
        map.listed.push_back(ranks_of_part(part, num_parts, num_ranks));
    return map;
}

int num_parts_of(std::span<const int> local_parts, int num_global_parts) {
    const Asked asked = asked_by(local_parts);
    const int total = num_global_parts < 0 ? asked.parts : num_global_parts;
    if (total == 0) throw_fatal("Zero parts requested");
    if (asked.parts > total || (asked.parts < total && asked.free_ranks == 0))
        throw_fatal("Sum of NUM_LOCAL_PARTS " + std::to_string(asked.parts) +
                    (asked.parts > total ? " > " : " < ") + "NUM_GLOBAL_PARTS " +
                    std::to_string(total));
    return total;
}

PartMap local_part_map(std::span<const int> local_parts, int num_parts) {
    const Asked asked = asked_by(local_parts);
    const int rest = num_parts - asked.parts;
    PartMap map{num_parts, static_cast<int>(local_parts.size()), false};
    int rank = 0;
    int free_ranks_left = asked.free_ranks;
    for (const int parts : local_parts) {
        const int extra = parts < 0 && free_ranks_left-- <= rest % asked.free_ranks ? 1 : 0;
        const int here = parts < 0 ? rest / asked.free_ranks + extra : parts;
        map.listed.insert(map.listed.end(), static_cast<std::size_t>(here), RankRange{rank, 1});
        const auto belongs_here = [&](int part) {
            const RankRange even = ranks_of_part(part, num_parts, map.num_ranks);
            return even.first_rank == rank && even.count == 1;
        };
        const int end = static_cast<int>(map.listed.size());
        map.is_even = map.is_even && here > 0 && belongs_here(end - here) && belongs_here(end - 1);
        ++rank;
    }
    if (map.is_even && num_parts > most_listed) map.listed = {};
    return map;
}

int first_part_of(const PartMap& map, int rank) {
    const PartRange here = map.parts_on(rank);
    return here.first < here.end ? here.first : -1;
}

}  // namespace rrcb::zoltan
