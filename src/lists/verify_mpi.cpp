#include "arithmetic/mix.hpp"
#include "collective/duplicate.hpp"
#include "lists/cell_list.hpp"
#include "lists/delivery_mpi.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/outgoing_mpi.hpp"
#include "lists/periodic_images.hpp"
#include "lists/radii.hpp"
#include "options/validation.hpp"

#include <array>
#include <iterator>
#include <numeric>
#include <random>
#include <tuple>

namespace rrcb {

namespace {

/// Point of the sample, which every rank gets.
struct Sample {
    Vector x{};
    double radius = std::numeric_limits<double>::quiet_NaN();  ///< within which it needs others
};

/// Point near one of the sample, on its way to the rank of that one.
struct Neighbour {
    std::uint64_t sample;  ///< number among those of that rank
    std::uint64_t index;
    std::uint64_t id;
    Shift shift;
    std::int32_t unused = 0;
};

/// Id of a point, on its way to the rank that collects all ranks of it.
struct IdNotice {
    std::uint64_t id;
    std::uint64_t is_now;  ///< 0: before a transfer
};

/// A list of faults.
enum class List : std::int32_t { missing, twice, strangers };

/// Fault of an id, on its way back.
struct IdFault {
    std::uint64_t id;
    std::int32_t rank;
    List list;
};

using GhostKey = std::tuple<int, std::uint64_t, Shift>;  ///< rank, index there, shift

/// Input of a verification on this rank.
struct VerifyRequest {
    const GhostPlan& plan;
    const Points& points;
    const VerifyOptions& options;
    Radii radii;
    PeriodicImages images;
    std::vector<LocalIndex> chosen{};  ///< sample of this rank

    std::uint64_t id_of(LocalIndex i) const { return options.ids ? (*options.ids)[i] : i; }

    void check() const {
        check_points(points);
        require(points.count == plan.num_points,
                "points must be as many as the plan of the ghosts has; give those of ghosts()");
        require(plan.shifts.empty() || plan.shifts.size() == total(plan.receive),
                "the shifts of the plan must be as many as the ghosts; give it as it was made");
        radii.check(points.count);
        require(!options.ids || options.ids->size() == points.count,
                "ids must have one entry for each point");
        require(options.ids || !options.ids_before || points.count == 0,
                "ids_before needs ids to compare with");
    }

    /// Returns the sample of this rank and room for those of others, `count` for each.
    std::vector<Sample> choose(std::size_t count, int rank, int num_ranks) {
        std::vector<LocalIndex> all(points.count);
        std::iota(all.begin(), all.end(), LocalIndex{0});
        std::mt19937_64 random(static_cast<std::uint64_t>(rank));
        std::ranges::sample(all, std::back_inserter(chosen), static_cast<std::ptrdiff_t>(count),
                            random);
        std::vector<Sample> samples(count * static_cast<std::size_t>(num_ranks));
        auto own = samples.begin() + static_cast<std::ptrdiff_t>(count) * rank;
        for (const LocalIndex i : chosen)
            *own++ = {points.position(i), radii.needs == Needs::sender ? -infinity : radii.of(i)};
        return samples;
    }

    /// Finds the points of this rank near the samples, by all pairs of neighbouring cells.
    Outgoing<Neighbour> neighbours_of(std::span<const Sample> samples, std::size_t num_each,
                                      int rank) const {
        const CellList cells(points);
        const double greatest = radii.needs == Needs::receiver ? -infinity : radii.greatest();
        Outgoing<Neighbour> found;
        for (std::size_t k = 0; k < samples.size(); ++k) {
            const Sample& sample = samples[k];
            const int to = static_cast<int>(k / num_each);
            if (std::isnan(sample.radius) || (points.count == 0)) continue;
            const double reach = std::max(sample.radius, greatest);
            images.for_each(Ball(sample.x, reach), [&](const Shift& back, const Vector& centre) {
                const Shift shift{-back[0], -back[1], -back[2]};
                if (to == rank && shift == Shift{}) return;
                cells.for_each_near(centre, with_rounding(reach, centre, sample.x),
                                    [&](LocalIndex i) {
                                        if (is_near(i, shift, sample))
                                            found.add(to, {k % num_each, i, id_of(i), shift});
                                    });
            });
        }
        return found;
    }

  private:
    static double with_rounding(double reach, const Vector& x, const Vector& y) {
        double size = reach;
        for (std::size_t a = 0; a < max_dimension; ++a)
            size = std::max({size, std::abs(x[a]), std::abs(y[a])});
        return reach + 1e-12 * size;
    }

    bool is_near(LocalIndex i, const Shift& shift, const Sample& sample) const {
        const Ball ball(images.image(points.position(i), shift), radii.of_sender(i));
        Vector apart{};
        for (int a = 0; a < points.dimension; ++a)
            apart[a] = std::abs(ball.centre()[a] - sample.x[a]);
        return ball.widened(sample.radius).touches(apart, points.dimension);
    }
};

/// Gives every rank the samples of all. Collective.
std::vector<Sample> share_samples(VerifyRequest& request, std::size_t& num_each,
                                  Participant& self) {
    const int num_ranks = mpi::size_of(self.comm);
    std::uint64_t most = request.points.count;
    self.check(MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_UINT64_T, MPI_MAX, self.comm),
               "MPI_Allreduce");
    const std::size_t sample = request.options.sample;
    const auto ranks = static_cast<std::size_t>(num_ranks);
    num_each = std::min<std::size_t>(most, sample / ranks + (sample % ranks > 0 ? 1 : 0));
    std::vector<Sample> samples;
    int num_bytes = 0;
    self.attempt([&] {
        num_bytes = mpi::to_int(static_cast<std::int64_t>(num_each * sizeof(Sample)));
        samples = request.choose(num_each, mpi::rank_of(self.comm), num_ranks);
    });
    agree(self);
    self.check(
        MPI_Allgather(MPI_IN_PLACE, 0, MPI_BYTE, samples.data(), num_bytes, MPI_BYTE, self.comm),
        "MPI_Allgather");
    return samples;
}

/// Compares ghosts with the neighbours of this rank's samples. Collective.
void compare_ghosts(const VerifyRequest& request, std::span<const Arrived<Neighbour>> neighbours,
                    Verification& seen, Participant& self) {
    const GhostPlan& plan = request.plan;
    std::vector<std::uint64_t> own_indices;
    std::vector<std::uint64_t> own_ids;
    std::vector<std::uint64_t> indices;
    std::vector<std::uint64_t> ids;
    self.attempt([&] {
        for (LocalIndex i = 0; i < request.points.count; ++i) {
            own_indices.push_back(i);
            own_ids.push_back(request.id_of(i));
        }
    });
    const std::array columns{detail::byte_column(column(own_indices), indices),
                             detail::byte_column(column(own_ids), ids)};
    move(plan, columns, {}, nullptr, self);
    self.attempt([&] {
        const int rank = mpi::rank_of(self.comm);
        std::vector<std::pair<GhostKey, std::uint64_t>> ghosts;
        for (const RankCount& from : plan.receive)
            for (LocalIndex n = 0; n < from.count; ++n) {
                const std::size_t k = ghosts.size();
                const Shift shift = plan.shifts.empty() ? Shift{} : plan.shifts[k];
                ghosts.push_back({{from.rank, indices[k], shift}, ids[k]});
            }
        std::ranges::sort(ghosts);
        for (std::size_t k = 0; k < ghosts.size(); ++k) {
            const auto& [key, id] = ghosts[k];
            const Fault fault{id, std::get<int>(key), id};
            if (k > 0 && ghosts[k - 1].first == key) seen.twice.push_back(fault);
            if (fault.rank == rank && std::get<Shift>(key) == Shift{})
                seen.strangers.push_back(fault);
        }
        for (const auto& [source, neighbour] : neighbours)
            if (!std::ranges::binary_search(ghosts,
                                            GhostKey{source, neighbour.index, neighbour.shift}, {},
                                            [](const auto& ghost) { return ghost.first; }))
                seen.missing.push_back(
                    {neighbour.id, source, request.id_of(request.chosen[neighbour.sample])});
    });
}

/// Answers the ranks of one id: several that have it, none now, or none before.
void find_faults(std::span<const Arrived<IdNotice>> of_id, bool has_before,
                 Outgoing<IdFault>& faults) {
    const auto first_now = std::ranges::find(
        of_id, 1u, [](const Arrived<IdNotice>& notice) { return notice.second.is_now; });
    const std::span before(of_id.begin(), first_now);
    const std::span now(first_now, of_id.end());
    const auto add = [&](int to, int rank, List list) {
        faults.add(to, {of_id[0].second.id, rank, list});
    };
    for (const auto& [rank, notice] : now)
        if (now.size() > 1)
            add(rank, rank == now[0].first ? now[1].first : now[0].first, List::twice);
        else if (has_before && before.empty())
            add(rank, rank, List::strangers);
    if (now.empty()) add(before[0].first, before[0].first, List::missing);
}

std::vector<Fault>& list_of(Verification& seen, List list) {
    if (list == List::missing) return seen.missing;
    return list == List::twice ? seen.twice : seen.strangers;
}

/// Compares the ids of all ranks, now and, if any rank has some, before a transfer. Collective.
void compare_ids(const VerifyOptions& options, bool has_before, Verification& seen,
                 Participant& self) {
    Outgoing<IdNotice> notices;
    const auto add = [&](std::span<const std::uint64_t> ids, std::uint64_t is_now) {
        const auto num_ranks = static_cast<std::uint64_t>(mpi::size_of(self.comm));
        for (const std::uint64_t id : ids)
            notices.add(static_cast<int>(mix(id) % num_ranks), {id, is_now});
    };
    self.attempt([&] {
        if (options.ids) add(*options.ids, 1);
        if (options.ids_before) add(*options.ids_before, 0);
    });
    std::vector<Arrived<IdNotice>> arrived = notices.send(self);
    Outgoing<IdFault> faults;
    self.attempt([&] {
        const auto key = [](const Arrived<IdNotice>& notice) {
            return std::tuple(notice.second.id, notice.second.is_now, notice.first);
        };
        std::ranges::sort(arrived, {}, key);
        for (std::size_t begin = 0, end = 0; begin < arrived.size(); begin = end) {
            while (end < arrived.size() && arrived[end].second.id == arrived[begin].second.id)
                ++end;
            find_faults(std::span(arrived).subspan(begin, end - begin), has_before, faults);
        }
    });
    const std::vector<Arrived<IdFault>> returned = faults.send(self);
    self.attempt([&] {
        for (const auto& [source, fault] : returned)
            list_of(seen, fault.list).push_back({fault.id, fault.rank, fault.id});
    });
}

}  // namespace

Verification verify(const GhostPlan& plan, const Points& points, const VerifyOptions& options,
                    Participant& self) {
    const double radius =
        std::isnan(options.radius) && !options.radii ? plan.radius : options.radius;
    VerifyRequest request{plan,
                          points,
                          options,
                          {radius, options.radii, plan.needs},
                          PeriodicImages(plan.periodic, points.dimension)};
    if (points.count == 0 && std::isnan(radius)) request.radii.each.emplace();
    self.attempt([&] { request.check(); });
    std::array shared{
        Shared{"whether ids are given", options.ids ? 1u : 0u, options.ids || points.count > 0},
        Shared{"whether ids_before are given", 1, options.ids_before.has_value()},
        Shared{"the sample", options.sample},
        Shared{"the dimension", static_cast<std::uint64_t>(points.dimension)},
        request.radii.each_given(points.count),
        request.radii.shared()};
    agree(self, shared);
    std::size_t num_each = 0;
    const std::vector<Sample> samples = share_samples(request, num_each, self);
    Outgoing<Neighbour> found;
    self.attempt(
        [&] { found = request.neighbours_of(samples, num_each, mpi::rank_of(self.comm)); });
    const std::vector<Arrived<Neighbour>> neighbours = found.send(self);
    Verification seen;
    compare_ghosts(request, neighbours, seen, self);
    if (shared[0].value != 0) compare_ids(options, shared[1].value != 0, seen, self);
    std::array<std::int64_t, 2> totals{
        std::ssize(neighbours),
        std::ssize(seen.missing) + std::ssize(seen.twice) + std::ssize(seen.strangers)};
    agree(self);
    self.check(MPI_Allreduce(MPI_IN_PLACE, totals.data(), 2, MPI_INT64_T, MPI_SUM, self.comm),
               "MPI_Allreduce");
    seen.num_pairs = totals[0];
    seen.num_faults = totals[1];
    return seen;
}

Verification verify(const GhostPlan& plan, const Points& points, const VerifyOptions& options,
                    MPI_Comm user) {
    Participant self = mpi::enter(user, CallName::verify);
    Verification seen = verify(plan, points, options, self);
    self.throw_alone();
    return seen;
}

}  // namespace rrcb
