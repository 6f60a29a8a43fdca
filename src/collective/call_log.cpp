#include "collective/call_log.hpp"

#include <algorithm>

namespace rrcb {

std::string_view name_of(CallName call) {
    constexpr std::array names{"no function",
                               "balance",
                               "balance_as_in_paper",
                               "plan",
                               "remap",
                               "transfer",
                               "ghost_plan",
                               "fetch",
                               "accumulate",
                               "groups",
                               "fetch of groups",
                               "group_sums",
                               "part_weights",
                               "moved_fraction",
                               "assign",
                               "rrcb_balancer_create (Python: balance, assign)",
                               "Controller",
                               "Controller::step",
                               "CostModel",
                               "CostModel::step",
                               "verify",
                               "save",
                               "load",
                               "join_keys",
                               "reply",
                               "Neighbours",
                               "Neighbours::migrate",
                               "Neighbours::find_ghosts",
                               "Neighbours::fetch",
                               "Neighbours::accumulate",
                               "Neighbours::sum",
                               "Neighbours::fail",
                               "fetch of known columns",
                               "accumulate of known columns",
                               "reply of known columns"};
    static_assert(names.size() == static_cast<std::size_t>(CallName::kept_reply) + 1 &&
                  names.size() <= most_call_names);
    return names.at(static_cast<std::size_t>(call));
}

namespace {

/// Returns the first difference between the calls of one rank and those of the others, among the
/// calls that both records contain.
std::optional<CallDifference> find_difference_from(std::size_t rank,
                                                   std::span<const CallRecord> known) {
    const CallRecord& mine = known[rank];
    std::optional<CallDifference> found;
    std::uint32_t end = mine.number();
    for (std::size_t other = 0; other < known.size(); ++other) {
        const CallRecord& theirs = known[other];
        const std::uint32_t most = std::max(mine.number(), theirs.number());
        std::uint32_t k = most - std::min(most, CallRecord::num_kept);
        for (; k < std::min(end, theirs.number()); ++k) {
            if (theirs.call(k) == mine.call(k)) continue;
            found = {{static_cast<int>(rank), static_cast<int>(other)},
                     {mine.call(k), theirs.call(k)}};
            end = k;
        }
    }
    return found;
}

}  // namespace

std::optional<CallDifference> find_different_calls(std::span<const CallRecord> known) {
    if (std::ranges::any_of(known, [](const CallRecord& one) { return one.number() == 0; }))
        return std::nullopt;
    if (const auto found = find_difference_from(0, known)) return found;
    // A rank may be many calls ahead of the rank with the fewest calls, so that records do not
    // overlap. The neighbours of that rank cannot be so far ahead, because they wait for it.
    const auto last = std::ranges::min_element(known, {}, &CallRecord::number);
    return find_difference_from(static_cast<std::size_t>(last - known.begin()), known);
}

std::string text_of(const CallDifference& difference) {
    const auto& [ranks, calls] = difference;
    return "rank " + std::to_string(ranks[0]) + " calls " + std::string(name_of(calls[0])) +
           ", rank " + std::to_string(ranks[1]) + " calls " + std::string(name_of(calls[1])) +
           "; every rank must make the same calls in the same order";
}

int CallLog::tag(int kind) const {
    // The tag is below 32,768, which every MPI allows. Ranks are never so many calls apart that
    // equal tags could be confused.
    constexpr int most_kinds = 16;
    const auto number = static_cast<int>(mine.number() % (2 * CallRecord::num_kept));
    return kind + most_kinds * (static_cast<int>(mine.latest()) + most_call_names * number);
}

}  // namespace rrcb
