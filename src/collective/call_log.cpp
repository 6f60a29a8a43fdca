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
                               "ghosts",
                               "fetch",
                               "accumulate",
                               "groups",
                               "fetch of groups",
                               "sums",
                               "part_weights",
                               "moved_fraction",
                               "gather_cuts",
                               "assign_all",
                               "rrcb_create (Python: balance, assign_all)",
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
                               "Neighbours::sum"};
    static_assert(names.size() == static_cast<std::size_t>(CallName::sum) + 1 &&
                  names.size() <= most_call_names);
    return names.at(static_cast<std::size_t>(call));
}

std::optional<CallDifference> find_different_calls(std::span<const CallRecord> known) {
    const auto [least, most] = std::ranges::minmax(known, {}, &CallRecord::number);
    std::uint32_t k = most.number() - std::min(most.number(), CallRecord::num_kept);
    for (; k < least.number(); ++k) {
        const CallName first = known[0].call(k);
        const auto other = std::ranges::find_if(
            known, [&](const CallRecord& one) { return one.call(k) != first; });
        if (other != known.end())
            return CallDifference{{0, static_cast<int>(other - known.begin())},
                                  {first, other->call(k)}};
    }
    return std::nullopt;
}

std::string text_of(const CallDifference& difference) {
    const auto& [ranks, calls] = difference;
    return "rank " + std::to_string(ranks[0]) + " calls " + std::string(name_of(calls[0])) +
           ", rank " + std::to_string(ranks[1]) + " calls " + std::string(name_of(calls[1])) +
           "; every rank must make the same calls in the same order";
}

int CallLog::tag(int kind) const {
    // Below 32,768, which every MPI allows. Ranks are never so many calls apart as to mix them up.
    constexpr int most_kinds = 16;
    const auto number = static_cast<int>(mine.number() % (2 * CallRecord::num_kept));
    return kind + most_kinds * (static_cast<int>(mine.latest()) + most_call_names * number);
}

}  // namespace rrcb
