#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/stamp_access.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/notices_mpi.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <rrcb/detail/mix.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

// Both functions below use homes. The home of a key is a rank chosen by the key's hash. Ranks send
// their labels of the key to its home, which returns the least label to all ranks that have a
// larger one.
//
// Groups: a label is a rank, so the lowest rank with a key owns its group. The other ranks send
// their sums to the owner, which adds them up and notes these ranks.
//
// Joined keys: each rank joins the keys of each of its points, and gives joined keys the least of
// their labels. Labels only decrease, so the rounds end.

namespace rrcb {

namespace {

/// A key and its label on a rank.
struct LabelNotice {
    std::uint64_t key;
    std::uint64_t label;
    std::uint64_t index;  ///< index of the key on the sending rank
};

/// Least label of a key, for a rank that has another one.
struct LeastLabel {
    std::uint64_t index;
    std::uint64_t label;
};

/// Labels of keys, to be sent to the homes of the keys.
struct Labels : Outgoing<LabelNotice> {
    void add(const LabelNotice& notice, int num_ranks) {
        const auto home = detail::mix(notice.key) % static_cast<std::uint64_t>(num_ranks);
        Outgoing::add(static_cast<int>(home), notice);
    }
};

/// Returns the answers to all ranks whose label of a key is not the least one.
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

/// Returns the least label of each key for which this rank has another label. Collective: two
/// exchanges.
std::vector<Arrived<LeastLabel>> least_of(const Labels& labels,
                                          std::initializer_list<Shared> arguments,
                                          Participant& self) {
    std::vector<Arrived<LabelNotice>> at_home = labels.send(self, arguments);
    Outgoing<LeastLabel> answers;
    self.attempt([&] { answers = answer(at_home); });
    return answers.send(self);
}

/// Weight and position of a group, summed over the points known so far.
struct GroupSum {
    double weight = 0;
    std::uint64_t count = 0;
    Vector place{};

    /// Adds a sum. If `moves`, the position becomes the weighted mean; as long as no point has
    /// weight, it is the mean of all points. The new position is between both old ones, and does
    /// not overflow.
    void add(const GroupSum& other, bool moves) {
        count += other.count;
        weight += other.weight;
        const double share = weight > 0
                                 ? other.weight / weight
                                 : static_cast<double>(other.count) / static_cast<double>(count);
        for (std::size_t a = 0; moves && a < max_dimension; ++a)
            place[a] = std::lerp(place[a], other.place[a], share);
    }
};

struct SumNotice {
    std::uint64_t key;
    GroupSum sum;
};

/// Groups of this rank's points, numbered in the order of their first points.
struct LocalGroups {
    std::vector<std::uint64_t> keys;    ///< key of each group
    std::vector<GroupSum> sums;         ///< sum of each group
    std::vector<LocalIndex> of_points;  ///< group of each point
    std::vector<LocalIndex> by_key;     ///< groups with a key, by ascending key

    LocalIndex with_key(std::uint64_t key) const {
        return *std::ranges::lower_bound(by_key, key, {}, [&](LocalIndex g) { return keys[g]; });
    }
};

LocalGroups groups_here(const Points& points, std::span<const std::uint64_t> keys,
                        GroupPlace place) {
    std::vector<std::pair<std::uint64_t, LocalIndex>> sorted;
    for (LocalIndex i = 0; i < points.count; ++i)
        if (keys[i] != no_group) sorted.emplace_back(keys[i], i);
    std::ranges::sort(sorted);
    std::vector<LocalIndex> first(points.count);  // for each point, the first point with the same
                                                  // key
    for (LocalIndex i = 0; i < points.count; ++i) first[i] = i;
    for (std::size_t k = 1; k < sorted.size(); ++k)
        if (sorted[k].first == sorted[k - 1].first)
            first[sorted[k].second] = first[sorted[k - 1].second];
    LocalGroups local;
    local.of_points.resize(points.count);
    for (LocalIndex i = 0; i < points.count; ++i) {
        const GroupSum point{points.weight(i), 1, points.position(i)};
        local.of_points[i] = first[i] == i ? local.keys.size() : local.of_points[first[i]];
        if (first[i] == i) {
            local.keys.push_back(keys[i]);
            local.sums.push_back(point);
        } else {
            local.sums[local.of_points[i]].add(point, place == GroupPlace::centre);
        }
    }
    for (const auto& [key, i] : sorted)
        if (first[i] == i) local.by_key.push_back(local.of_points[i]);
    return local;
}

/// Numbers the groups that this rank owns, then the others. Returns the sums to be sent to their
/// owners.
Outgoing<SumNotice> number_groups(const LocalGroups& local,
                                  std::span<const Arrived<LeastLabel>> owners, int num_ranks,
                                  Groups& result, std::vector<LocalIndex>& numbers) {
    constexpr auto unknown = std::numeric_limits<LocalIndex>::max();
    numbers.assign(local.keys.size(), 0);
    Outgoing<SumNotice> sums;
    std::vector<LocalIndex> elsewhere;
    for (const auto& [source, notice] : owners) {
        numbers[notice.index] = unknown;
        elsewhere.push_back(notice.index);
        sums.add(static_cast<int>(notice.label),
                 {local.keys[notice.index], local.sums[notice.index]});
    }
    LocalIndex num_groups = 0;
    for (LocalIndex& number : numbers)
        if (number != unknown) number = num_groups++;
    RankOrder order(sums.ranks, num_ranks);
    result.plan.receive = order.counts();
    order.for_each(
        [&](std::size_t k, std::size_t place) { numbers[elsewhere[k]] = num_groups + place; });
    result.plan.num_points = num_groups;
    result.of_points.reserve(local.of_points.size());
    for (const LocalIndex group : local.of_points) result.of_points.push_back(numbers[group]);
    return sums;
}

/// Adds the sums of other ranks to the groups of this rank, and lists those ranks.
void complete(std::span<const Arrived<SumNotice>> sums, GroupPlace place, LocalGroups& local,
              std::span<const LocalIndex> numbers, Groups& result) {
    for (const auto& [source, notice] : sums) {
        const LocalIndex group = local.with_key(notice.key);
        local.sums[group].add(notice.sum, place == GroupPlace::centre);
        std::vector<RankCount>& send = result.plan.send;
        if (send.empty() || send.back().rank != source) send.push_back({source, 0});
        ++send.back().count;
        result.plan.send_indices.push_back(numbers[group]);
    }
    for (LocalIndex group = 0; group < local.sums.size(); ++group) {
        if (numbers[group] >= result.plan.num_points) continue;
        const GroupSum& sum = local.sums[group];
        require(std::isfinite(sum.weight),
                "the sum of the weights of a group overflows; scale them down");
        result.weights.push_back(sum.weight);
        for (int a = 0; a < result.dimension; ++a) result.coordinates.push_back(sum.place[a]);
    }
}

}  // namespace

Groups groups(const Points& points, std::span<const std::uint64_t> keys, GroupPlace place,
              Participant& self) {
    const int num_ranks = mpi::size_of(self.comm);
    Groups result;
    result.dimension = points.dimension;
    detail::StampAccess::ranks(result.plan.stamp) = self.group();
    LocalGroups local;
    Labels ranks;
    self.attempt([&] {
        require(keys.size() == points.count,
                "keys must have one entry for each point; no_group for those without");
        require(place == GroupPlace::centre || place == GroupPlace::first_point,
                "the place of groups must be their centre or their first point");
        check_points(points);
        local = groups_here(points, keys, place);
        const auto rank = static_cast<std::uint64_t>(mpi::rank_of(self.comm));
        for (const LocalIndex group : local.by_key)
            ranks.add({local.keys[group], rank, group}, num_ranks);
    });
    const std::vector<Arrived<LeastLabel>> owned_elsewhere =
        least_of(ranks,
                 {{"the dimension", static_cast<std::uint64_t>(points.dimension)},
                  {"the place of groups", static_cast<std::uint64_t>(place)},
                  weights_given(points)},
                 self);
    Outgoing<SumNotice> to_owners;
    std::vector<LocalIndex> numbers;
    self.attempt(
        [&] { to_owners = number_groups(local, owned_elsewhere, num_ranks, result, numbers); });
    const std::vector<Arrived<SumNotice>> of_members = to_owners.send(self);
    self.attempt([&] { complete(of_members, place, local, numbers, result); });
    agree(self);
    return result;
}

Groups groups(const Points& points, std::span<const std::uint64_t> keys, MPI_Comm comm,
              GroupPlace place) {
    Participant self = mpi::enter(comm, CallName::groups);
    return groups(points, keys, place, self);
}

namespace {

/// Keys of this rank's points, of which sets are joined.
class LocalKeys {
  public:
    LocalKeys() = default;
    LocalKeys(std::span<const std::uint64_t> keys, std::size_t keys_per_point) {
        for (const std::uint64_t key : keys)
            if (key != no_group) keys_.push_back(key);
        std::ranges::sort(keys_);
        keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
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

    /// Returns the label of a point's keys, or no_group if it has no keys.
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
    /// Joins two sets of keys. The least key becomes the top of the new set, and is its label.
    void join(std::size_t a, std::size_t b) {
        a = top_of(a);
        b = top_of(b);
        parents_[std::max(a, b)] = std::min(a, b);
    }

    std::vector<std::uint64_t> keys_;    ///< ascending
    std::vector<std::uint64_t> labels_;  ///< valid for the top of each set
    std::vector<std::size_t> parents_;
};

/// Runs one round in which labels may decrease. Returns false if no label has changed on any rank.
/// Collective.
bool lower_labels(LocalKeys& local, std::size_t keys_per_point, Participant& self) {
    Labels labels;
    self.attempt([&] {
        for (std::size_t k = 0; k < local.keys().size(); ++k)
            labels.add({local.keys()[k], local.label(k), k}, mpi::size_of(self.comm));
    });
    const std::vector<Arrived<LeastLabel>> least =
        least_of(labels, {{"keys_per_point", static_cast<std::uint64_t>(keys_per_point)}}, self);
    for (const auto& [home, label] : least) local.lower(label);
    return mpi::sum_of(least.empty() ? 0 : 1, self.comm) > 0;
}

}  // namespace

namespace experimental {

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

}  // namespace experimental

}  // namespace rrcb
