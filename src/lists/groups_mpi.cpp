#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/notices_mpi.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

// The ranks of a group find each other in three exchanges:
//   keys      to the rank given by their hash, which thus learns all ranks of a key.
//   owners    back to all ranks of a key except the lowest, which owns the group.
//   sums      from these to the owner, which adds them up and notes their ranks.

namespace rrcb {

namespace {

/// Weight and position of a group, of the points known so far.
struct GroupSum {
    double weight = 0;
    std::uint64_t count = 0;
    Vector place{};

    /// Adds a sum. If `moves`, the position becomes the weighted mean, or that of all points as
    /// long as none has weight. It stays between both positions and does not overflow.
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

/// A key on its way to the rank that collects all ranks of it.
struct KeyNotice {
    std::uint64_t key;
    std::uint64_t group;  ///< number on the rank that sends it
};

/// Owner of a group that other ranks have too.
struct OwnerNotice {
    std::uint64_t group;
    std::int64_t owner;
};

struct SumNotice {
    std::uint64_t key;
    GroupSum sum;
};

/// Groups of the points of this rank, numbered by their first points.
struct LocalGroups {
    std::vector<std::uint64_t> keys;    ///< of each
    std::vector<GroupSum> sums;         ///< of each
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
    std::vector<LocalIndex> first(points.count);  // first point with the key of each
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

/// Answers all ranks of each key except the lowest, the owner.
Outgoing<OwnerNotice> name_owners(std::vector<Arrived<KeyNotice>>& keys) {
    std::ranges::sort(
        keys, {}, [](const auto& notice) { return std::pair(notice.second.key, notice.first); });
    Outgoing<OwnerNotice> owners;
    int owner = 0;
    for (std::size_t k = 0; k < keys.size(); ++k) {
        const auto& [rank, notice] = keys[k];
        const bool is_lowest = k == 0 || keys[k - 1].second.key != notice.key;
        if (is_lowest) owner = rank;
        if (!is_lowest) owners.add(rank, {notice.group, owner});
    }
    return owners;
}

/// Numbers the groups that this rank owns, then the others; returns the sums for their owners.
Outgoing<SumNotice> number_groups(const LocalGroups& local,
                                  std::span<const Arrived<OwnerNotice>> owners, int num_ranks,
                                  Groups& result, std::vector<LocalIndex>& numbers) {
    constexpr auto unknown = std::numeric_limits<LocalIndex>::max();
    numbers.assign(local.keys.size(), 0);
    Outgoing<SumNotice> sums;
    std::vector<LocalIndex> elsewhere;
    for (const auto& [source, notice] : owners) {
        numbers[notice.group] = unknown;
        elsewhere.push_back(notice.group);
        sums.add(static_cast<int>(notice.owner),
                 {local.keys[notice.group], local.sums[notice.group]});
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

/// Adds the sums of other ranks to the groups of this one, and lists these ranks.
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
    result.plan.group = self.group();
    LocalGroups local;
    Outgoing<KeyNotice> to_homes;
    self.attempt([&] {
        require(keys.size() == points.count,
                "keys must have one entry for each point; no_group for those without");
        require(place == GroupPlace::centre || place == GroupPlace::first_point,
                "the place of groups must be their centre or their first point");
        check_points(points);
        local = groups_here(points, keys, place);
        for (const LocalIndex group : local.by_key) {
            const std::uint64_t key = local.keys[group];
            to_homes.add(home_of(key, num_ranks), {key, group});
        }
    });
    std::vector<Arrived<KeyNotice>> at_home =
        to_homes.send(self, {{"the dimension", static_cast<std::uint64_t>(points.dimension)},
                             {"the place of groups", static_cast<std::uint64_t>(place)},
                             weights_given(points)});
    Outgoing<OwnerNotice> owners;
    self.attempt([&] { owners = name_owners(at_home); });
    const std::vector<Arrived<OwnerNotice>> owned_elsewhere = owners.send(self);
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

}  // namespace rrcb
