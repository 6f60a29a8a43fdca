// The search for cuts by many ranks in one process, through the code that ranks run.
#pragma once

#include "search/tree_search.hpp"
#include "virtual_butterfly.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace rrcb::test {

/// What a search of all ranks amounted to.
struct SearchCounts {
    int rounds = 0;
    std::size_t longest = 0;        ///< message, in bytes
    std::size_t most_bytes_in = 0;  ///< into one rank in a round, there and back
};

/// Ends the searches of all ranks. In each round observe(butterflies) is called when the owners
/// have their records, and when they have answered.
template <class Observe>
SearchCounts run_searches(std::vector<std::unique_ptr<TreeSearch>>& searches, Butterfly::Way way,
                          Observe&& observe) {
    const auto none_fails = [](int, int) { return false; };
    std::vector<Butterfly> butterflies;
    for (std::size_t rank = 0; rank < searches.size(); ++rank)
        butterflies.emplace_back(static_cast<int>(rank), static_cast<int>(searches.size()),
                                 TreeSearch::join, way);
    const std::vector<Flags> flags(searches.size());
    SearchCounts counts;
    const auto is_searching = [](const auto& search) { return search->is_searching(); };
    while (std::ranges::any_of(searches, is_searching)) {
        for (std::size_t rank = 0; rank < searches.size(); ++rank) {
            butterflies[rank].clear();
            searches[rank]->ask(butterflies[rank]);
        }
        const auto there = run_pass(butterflies, Butterfly::to_owners, flags, none_fails);
        observe(butterflies);
        for (std::size_t rank = 0; rank < searches.size(); ++rank)
            searches[rank]->decide(butterflies[rank]);
        observe(butterflies);
        const auto back = run_pass(butterflies, Butterfly::back, flags, none_fails);
        for (std::size_t rank = 0; rank < searches.size(); ++rank)
            searches[rank]->follow(butterflies[rank]);
        ++counts.rounds;
        counts.longest = std::max({counts.longest, there.longest, back.longest});
        counts.most_bytes_in =
            std::max(counts.most_bytes_in, there.most_bytes_in + back.most_bytes_in);
    }
    return counts;
}

inline SearchCounts run_searches(std::vector<std::unique_ptr<TreeSearch>>& searches) {
    return run_searches(searches, Butterfly::Way::spread, [](const auto&) {});
}

}  // namespace rrcb::test
