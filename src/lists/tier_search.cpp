#include "lists/tier_search.hpp"

#include "cuts/owned_cuts.hpp"
#include "cuts/packed_tree.hpp"

#include <rrcb/error.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <utility>

namespace rrcb {

namespace {

constexpr int top_depth = 6;
constexpr int tier_depth = 7;

/// Returns the first level of a level's tier.
constexpr int tier_begin(int depth) {
    return depth < top_depth ? 0 : depth - (depth - top_depth) % tier_depth;
}

/// A node and its cut in a message.
struct NamedCut {
    std::int64_t node;
    Cut cut;
};
constexpr std::size_t words_per_cut = sizeof(NamedCut) / sizeof(double);
using Words = std::array<double, words_per_cut>;
static_assert(sizeof(NamedCut) == sizeof(Words));

}  // namespace

void TierSearch::join_cuts(std::span<const double> a, std::span<const double> b,
                           std::vector<double>& joined) {
    joined.insert(joined.end(), a.begin(), a.end());
    joined.insert(joined.end(), b.begin(), b.end());
}

/// Returns the first node of a node's tier.
Descent TierSearch::tier_of(std::size_t node) const {
    Descent first = root_of(cuts_);
    Descent at = first;
    // The node is at or below `at`, and `first` begins the tier of `at`.
    for (int depth = 1; at.node != node; ++depth) {
        at = node >= at.upper().node ? at.upper() : at.lower();
        if (tier_begin(depth) == depth) first = at;
    }
    return first;
}

void TierSearch::share(Butterfly& shared) const {
    std::map<Key, std::pair<int, std::vector<double>>> tiers;
    const int num_ranks = shared.num_ranks();
    for_each_owned(cuts_, shared.rank(), num_ranks, [&](std::size_t node, const Cut& cut) {
        const Descent tier = tier_of(node);
        auto& [owner, words] = tiers[tier.node];
        owner = owner_of(tier, cuts_.num_parts, num_ranks);
        const auto named = std::bit_cast<Words>(NamedCut{static_cast<std::int64_t>(node), cut});
        words.insert(words.end(), named.begin(), named.end());
    });
    for (const auto& [key, tier] : tiers) shared.add(key, tier.first, tier.second);
}

void TierSearch::ask(std::span<const std::size_t> nodes, Butterfly& asked) {
    std::map<Key, int> owners;
    for (const std::size_t node : nodes) {
        const Descent tier = tier_of(node);
        owners[tier.node] = owner_of(tier, cuts_.num_parts, asked.num_ranks());
    }
    tiers_.clear();
    for (const auto& [key, owner] : owners) {
        tiers_.push_back(key);
        asked.add(key, owner, {});
    }
}

void TierSearch::answer(const Butterfly& shared, Butterfly& asked) const {
    RecordReader tiers = shared.owned().read();
    asked.owned().for_each([&](const Record& question) {
        // Both ascend by key.
        while (!tiers.at_end()) {
            const Record tier = tiers.next();
            if (tier.key == question.key) return asked.answer(tier.key, tier.payload);
        }
    });
}

void TierSearch::learn(const Butterfly& asked) {
    std::map<std::int32_t, Cut> known;
    for (std::size_t k = 0; k < cuts_.nodes.size(); ++k) known[cuts_.nodes[k]] = cuts_.tree[k];
    std::size_t num_answers = 0;
    asked.answers().for_each([&](const Record& answer) {
        if (!std::ranges::binary_search(tiers_, answer.key)) return;
        ++num_answers;
        for (auto words = answer.payload; !words.empty(); words = words.subspan(words_per_cut)) {
            Words one;
            std::copy_n(words.begin(), words_per_cut, one.begin());
            const auto named = std::bit_cast<NamedCut>(one);
            known[static_cast<std::int32_t>(named.node)] = named.cut;
        }
    });
    if (num_answers < tiers_.size())
        throw Error(ErrorCode::internal,
                    "other ranks sent too few of their cuts; report this with rrcb::build_info()");
    cuts_.nodes.clear();
    cuts_.tree.clear();
    for (const auto& [node, cut] : known) {
        cuts_.nodes.push_back(node);
        cuts_.tree.push_back(cut);
    }
}

PathSearch::PathSearch(const Cuts& known, const Points& points, std::span<Part> parts)
    : TierSearch(known), points_(points), parts_(parts) {
    for (LocalIndex i = 0; i < parts.size(); ++i)
        if (is_unknown(parts[i])) searched_.push_back(i);
    left_ = searched_;
}

bool PathSearch::ask(Butterfly& asked) {
    std::vector<std::size_t> nodes;
    for (const LocalIndex i : left_) {
        const Descent from = node_at(cuts(), unknown_node(parts_[i]));
        const Descent at = descend(cuts(), points_.position(i), from);
        parts_[i] = at.is_part() ? at.first_part : unknown_below(at.node);
        if (!at.is_part() && (nodes.empty() || nodes.back() != at.node)) nodes.push_back(at.node);
    }
    std::erase_if(left_, [&](LocalIndex i) { return !is_unknown(parts_[i]); });
    TierSearch::ask(nodes, asked);
    return !left_.empty();
}

}  // namespace rrcb
