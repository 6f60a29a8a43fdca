#include "search/tree_rounds_mpi.hpp"

#include "collective/agreement_mpi.hpp"

namespace rrcb {

namespace {

/// Flags of a rank: whether it still searches, and the imbalance of its parts so far.
Flags flags_of(const std::optional<TreeSearch>& search) {
    if (!search) return {};
    return {0, search->is_searching() ? 1.0 : 0.0, search->imbalance()};
}

}  // namespace

int TreeRounds::run(std::optional<TreeSearch>& search, Participant& self) {
    const bool is_central = butterfly_.is_central();
    // Rank 0 of a central search knows all nodes, and sends with its answers whether any are left.
    const bool follows_first = is_central && rank() == root;
    // All ranks know the same flags after each round, and therefore agree on the next messages.
    for (int rounds = 0;; ++rounds) {
        butterfly_.clear();
        self.attempt([&] { search->ask(butterfly_); });
        messages_.run(butterfly_, Butterfly::to_owners, flags_of(search), self);
        if (!is_central && butterfly_.flags()[1] == 0) return rounds;
        self.attempt([&] { search->decide(butterfly_); });
        if (follows_first) self.attempt([&] { search->follow(butterfly_); });
        messages_.run(butterfly_, Butterfly::back, flags_of(search), self);
        if (!follows_first) self.attempt([&] { search->follow(butterfly_); });
        if (is_central && butterfly_.flags()[1] == 0) return rounds + 1;
    }
}

}  // namespace rrcb
