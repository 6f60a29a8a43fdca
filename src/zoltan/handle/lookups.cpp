#include "zoltan/handle/lookups.hpp"

#include "zoltan/real/message.hpp"

#include <algorithm>
#include <cfloat>
#include <string>
#include <vector>

namespace rrcb::zoltan {

namespace {

/// Writes the ranks of ascending parts, ascending; returns their number.
int write_ranks(const PartMap& map, const Part* parts, int num_parts, int* ranks) {
    int count = 0;
    for (int i = 0; i < num_parts; ++i) {
        const RankRange range = map.ranks_of(parts[i]);
        // The ranks of ascending parts ascend: only the last one can occur twice.
        const int next = count == 0 ? 0 : ranks[count - 1] + 1;
        for (int r = std::max(range.first_rank, next); r < range.first_rank + range.count; ++r) {
            ranks[count++] = r;
        }
    }
    return count;
}

}  // namespace

const LastPartition& last_of(const State& state) {
    if (!state.last || !state.last->answers_look_ups())
        throw_fatal("No Decomposition Data available; use KEEP_CUTS parameter.");
    return *state.last;
}

Place place_of(const State& state, const double* coordinates) {
    const LastPartition& last = last_of(state);
    const Part part = last.part_of(coordinates);
    return {last.map().ranks_of(part).first_rank, part};
}

void find_touched(const State& state, const Box& box, const Touched& touched) {
    const LastPartition& last = last_of(state);
    // Kept between calls: programs make tens of thousands of them.
    thread_local std::vector<Part> unasked;
    Part* parts = touched.parts;
    if (parts == nullptr) {
        unasked.resize(last.map().num_parts);
        parts = unasked.data();
    }
    const int count = last.parts_touching(box, parts);
    if (touched.parts != nullptr) *touched.num_parts = count;
    if (touched.ranks == nullptr) return;
    *touched.num_ranks = write_ranks(last.map(), parts, count, touched.ranks);
}

Box region_of(const State& state, int part) {
    const LastPartition& last = last_of(state);
    if (part < 0 || part >= last.cuts().num_parts)
        throw_fatal("Invalid part number " + std::to_string(part));
    Box box = last.region_of(part);
    for (std::size_t a = 0; a < max_dimension; ++a) {
        const bool used = static_cast<int>(a) < last.cuts().dimension;
        box.lower[a] = used ? std::max(box.lower[a], -DBL_MAX) : -DBL_MAX;
        box.upper[a] = used ? std::min(box.upper[a], DBL_MAX) : DBL_MAX;
    }
    return box;
}

TreeNode tree_node_of(const State& state, int node) {
    const LastPartition& last = last_of(state);
    if (node < 0 || node >= last.cuts().num_parts)
        throw_fatal("Invalid tree node " + std::to_string(node));
    return last.tree_node(node);
}

void require_one_part_per_rank(const PartMap& map, const char* alternative) {
    if (map.one_each) return;
    throw_fatal(
        std::string("Non-uniform distribution of parts over processors is specified; use ") +
        alternative);
}

}  // namespace rrcb::zoltan
