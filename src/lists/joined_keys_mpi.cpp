#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/notices_mpi.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

// Each rank joins the keys of its points, and labels joined keys by the least. In each round the
// home of a key learns its labels, and answers the least one to the ranks that have another. Labels
// only fall, so the rounds end.

namespace rrcb {

namespace {

/// A key and its label on a rank.
struct LabelNotice {
    std::uint64_t key;
    std::uint64_t label;
    std::uint64_t index;  ///< of the key on the rank that sends it
};

/// The least label of a key.
struct LeastLabel {
    std::uint64_t index;
    std::uint64_t label;
};

/// Keys of the points of this rank.
class LocalKeys {
  public:
    LocalKeys() = default;
    LocalKeys(std::span<const std::uint64_t> keys, std::size_t keys_per_point) {
        for (const std::uint64_t key : keys)
            if (key != no_group) keys_.push_back(key);
        std::ranges::sort(keys_);
        keys_.erase(std::ranges::unique(keys_).begin(), keys_.end());
        labels_ = keys_;
        parents_.resize(keys_.size());
        std::iota(parents_.begin(), parents_.end(), std::size_t{0});
        for (std::size_t i = 0; i < keys.size(); i += keys_per_point) {
            const auto of_point = keys.subspan(i, keys_per_point);
            const auto first = std::ranges::find_if(of_point, is_key);
            for (const std::uint64_t key : of_point)
                if (is_key(key)) join(index_of(*first), index_of(key));
        }
    }

    std::span<const std::uint64_t> keys() const { return keys_; }
    std::uint64_t label(std::size_t key) { return labels_[top_of(key)]; }
    void lower(const LeastLabel& to) {
        std::uint64_t& label = labels_[top_of(to.index)];
        label = std::min(label, to.label);
    }

    /// Returns the label of the keys of a point; no_group without keys.
    std::uint64_t label_of(std::span<const std::uint64_t> of_point) {
        const auto first = std::ranges::find_if(of_point, is_key);
        return first == of_point.end() ? no_group : label(index_of(*first));
    }

  private:
    static bool is_key(std::uint64_t key) { return key != no_group; }
    std::size_t index_of(std::uint64_t key) const {
        return static_cast<std::size_t>(std::ranges::lower_bound(keys_, key) - keys_.begin());
    }
    std::size_t top_of(std::size_t key) {
        while (parents_[key] != key) key = parents_[key] = parents_[parents_[key]];
        return key;
    }
    /// The lesser key is on top, so its label is the least.
    void join(std::size_t a, std::size_t b) {
        a = top_of(a);
        b = top_of(b);
        parents_[std::max(a, b)] = std::min(a, b);
    }

    std::vector<std::uint64_t> keys_;    ///< ascending
    std::vector<std::uint64_t> labels_;  ///< valid at the top of joined keys
    std::vector<std::size_t> parents_;
};

/// Answers the ranks whose label of a key is not the least.
Outgoing<LeastLabel> answer(std::vector<Arrived<LabelNotice>>& notices) {
    std::ranges::sort(notices, {}, [](const auto& notice) {
        return std::pair(notice.second.key, notice.second.label);
    });
    Outgoing<LeastLabel> answers;
    std::uint64_t least = 0;
    for (std::size_t k = 0; k < notices.size(); ++k) {
        const auto& [rank, notice] = notices[k];
        if (k == 0 || notices[k - 1].second.key != notice.key) least = notice.label;
        if (notice.label != least) answers.add(rank, {notice.index, least});
    }
    return answers;
}

/// Lowers the labels once. Returns false if none changes on any rank. Collective.
bool lower_labels(LocalKeys& local, std::size_t keys_per_point, Participant& self) {
    const int num_ranks = mpi::size_of(self.comm);
    Outgoing<LabelNotice> to_homes;
    self.attempt([&] {
        for (std::size_t k = 0; k < local.keys().size(); ++k) {
            const std::uint64_t key = local.keys()[k];
            to_homes.add(home_of(key, num_ranks), {key, local.label(k), k});
        }
    });
    std::vector<Arrived<LabelNotice>> at_home =
        to_homes.send(self, {{"keys_per_point", static_cast<std::uint64_t>(keys_per_point)}});
    Outgoing<LeastLabel> answers;
    self.attempt([&] { answers = answer(at_home); });
    const std::vector<Arrived<LeastLabel>> least = answers.send(self);
    for (const auto& [rank, label] : least) local.lower(label);
    return mpi::sum_of(least.empty() ? 0 : 1, self.comm) > 0;
}

}  // namespace

std::vector<std::uint64_t> join_keys(std::span<const std::uint64_t> keys,
                                     std::size_t keys_per_point, Participant& self) {
    LocalKeys local;
    self.attempt([&] {
        require(keys_per_point > 0 && keys.size() % keys_per_point == 0,
                "keys must have keys_per_point entries, 1 or more, for each point; no_group for "
                "those that a point lacks");
        local = LocalKeys(keys, keys_per_point);
    });
    while (lower_labels(local, keys_per_point, self)) {
    }
    std::vector<std::uint64_t> joined;
    self.attempt([&] {
        for (std::size_t i = 0; i < keys.size(); i += keys_per_point)
            joined.push_back(local.label_of(keys.subspan(i, keys_per_point)));
    });
    agree(self);
    return joined;
}

std::vector<std::uint64_t> join_keys(std::span<const std::uint64_t> keys,
                                     std::size_t keys_per_point, MPI_Comm comm) {
    Participant self = mpi::enter(comm, CallName::join_keys);
    return join_keys(keys, keys_per_point, self);
}

}  // namespace rrcb
