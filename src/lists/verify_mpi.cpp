#include "collective/duplicate.hpp"
#include "lists/delivery_mpi.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/notices_mpi.hpp"
#include "lists/periodic_images.hpp"
#include "lists/radii.hpp"
#include "options/validation.hpp"

#include <array>
#include <iterator>
#include <numeric>
#include <random>
#include <tuple>

namespace rrcb::experimental {

namespace {

/// Point of the sample. Every rank receives all of the sample.
struct Sample {
    Vector x{};
    /// distance within which it needs other points
    double radius = std::numeric_limits<double>::quiet_NaN();
};

/// Point near a point of the sample, to be sent to the rank of the sample point.
struct Neighbour {
    std::uint64_t sample;  ///< number of the sample point on its rank
    std::uint64_t index;
    std::uint64_t id;
    Shift shift;
    std::int32_t unused = 0;
};

/// A rank's points in cells, about as many as points, for finding those near a position.
class CellList {
  public:
    explicit CellList(const Points& points) : box_(bounding_box(points)) {
        for (int a = 0; a < points.dimension; ++a)
            num_cells_[a] = std::max(1., std::floor(std::pow(points.count, 1. / points.dimension)));
        for (LocalIndex i = 0; i < points.count; ++i)
            cells_.emplace_back(cell_of(points.position(i)), i);
        std::ranges::sort(cells_);
    }

    /// Calls visit(point) for all points within `reach` along each axis, and for some others.
    template <class Visit>
    void for_each_near(const Vector& x, double reach, Visit&& visit) const {
        const auto at = [&](double by) { return cell_of({x[0] + by, x[1] + by, x[2] + by}); };
        const Vector first = at(-reach);
        const Vector last = at(reach);
        for (double i = first[0]; i <= last[0]; ++i)
            for (double j = first[1]; j <= last[1]; ++j) {
                const std::pair begin(Vector{i, j, first[2]}, LocalIndex{0});
                auto near = std::ranges::lower_bound(cells_, begin);
                for (; near != cells_.end() && near->first <= Vector{i, j, last[2]}; ++near)
                    visit(near->second);
            }
    }

  private:
    Vector cell_of(const Vector& x) const {
        Vector cell{};
        for (std::size_t a = 0; a < max_dimension; ++a) {
            const double share = (x[a] - box_.lower[a]) / (box_.upper[a] - box_.lower[a]);
            if (share > 0) cell[a] = std::min(std::floor(share * num_cells_[a]), num_cells_[a] - 1);
        }
        return cell;
    }

    Box box_;
    Vector num_cells_{1, 1, 1};
    std::vector<std::pair<Vector, LocalIndex>> cells_{};
};

using GhostKey = std::tuple<int, std::uint64_t, Shift>;  ///< rank, index there, shift

/// Input of a verification on this rank.
struct VerifyRequest {
    const GhostPlan& plan;
    const Points& points;
    const VerifyOptions& options;
    Radii radii;
    PeriodicImages images;
    std::vector<LocalIndex> chosen{};  ///< points of this rank in the sample

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

    /// Returns `count` samples for each rank: those of this rank are set, the others are to be
    /// received.
    std::vector<Sample> choose(std::size_t count, int rank, int num_ranks) {
        std::vector<LocalIndex> all(points.count);
        std::iota(all.begin(), all.end(), LocalIndex{0});
        std::mt19937_64 random(static_cast<std::uint64_t>(rank));
        std::ranges::sample(all, std::back_inserter(chosen), static_cast<std::ptrdiff_t>(count),
                            random);
        std::vector<Sample> samples(count * static_cast<std::size_t>(num_ranks));
        auto own = samples.begin() + static_cast<std::ptrdiff_t>(count) * rank;
        for (const LocalIndex i : chosen)
            *own++ = {points.position(i), radii.needs == Needs::scatter ? -infinity : radii.of(i)};
        return samples;
    }

    /// Finds the points of this rank near the samples, by comparing all pairs in neighbouring
    /// cells.
    Outgoing<Neighbour> neighbours_of(std::span<const Sample> samples, std::size_t num_each,
                                      int rank) const {
        const CellList cells(points);
        const double greatest = radii.needs == Needs::gather ? -infinity : radii.greatest();
        Outgoing<Neighbour> found;
        for (std::size_t k = 0; k < samples.size(); ++k) {
            const Sample& sample = samples[k];
            const int to = static_cast<int>(k / num_each);
            if (std::isnan(sample.radius) || points.count == 0) continue;
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

/// Gives every rank the samples of all ranks. Collective.
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

/// Compares the ghosts with the true neighbours of this rank's samples. Collective.
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
    move(plan, columns, {}, self);
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
            if (k > 0 && ghosts[k - 1].first == key) seen.duplicates.push_back(fault);
            if (fault.rank == rank && std::get<Shift>(key) == Shift{})
                seen.not_mine.push_back(fault);
        }
        for (const auto& [source, neighbour] : neighbours)
            if (!std::ranges::binary_search(ghosts,
                                            GhostKey{source, neighbour.index, neighbour.shift}, {},
                                            [](const auto& ghost) { return ghost.first; }))
                seen.missing.push_back(
                    {neighbour.id, source, request.id_of(request.chosen[neighbour.sample])});
    });
}

/// Compares the ids of all ranks after a transfer with those before it, if any rank has given the
/// latter. Equal ids form a group. Collective.
void compare_ids(const VerifyOptions& options, bool has_before, Verification& seen,
                 Participant& self) {
    constexpr std::size_t num_sums = 3;  // points now and before, and ranks of those now
    const double rank = mpi::rank_of(self.comm);
    std::vector<std::uint64_t> keys;
    std::vector<double> places;
    std::vector<double> values;
    std::size_t num_now = 0;
    self.attempt([&] {
        if (options.ids) keys.assign(options.ids->begin(), options.ids->end());
        num_now = keys.size();
        for (std::size_t k = 0; k < num_now; ++k) values.insert(values.end(), {1, 0, rank});
        if (options.ids_before)
            keys.insert(keys.end(), options.ids_before->begin(), options.ids_before->end());
        values.resize(num_sums * keys.size());
        for (std::size_t k = num_now; k < keys.size(); ++k) values[num_sums * k + 1] = 1;
        places.resize(keys.size());
    });
    const Groups ids = groups(Points(places, 1), keys, GroupPlace::first_point, self);
    const std::vector<double> sums_here = group_sums(ids, values, num_sums, self);
    std::vector<double> of_ids;
    const std::array columns{detail::byte_column(column(sums_here, num_sums), of_ids)};
    move(ids, columns, {}, self);
    self.attempt([&] {
        for (std::size_t k = 0; k < keys.size(); ++k) {
            const std::span sum = std::span(of_ids).subspan(num_sums * k, num_sums);
            const bool is_now = k < num_now;
            const Fault fault{keys[k], static_cast<int>(rank), keys[k]};
            const double other = sum[0] == 2 ? sum[2] - rank : -1;
            if (is_now && sum[0] > 1)
                seen.duplicates.push_back({fault.id, static_cast<int>(other), fault.id});
            if (is_now && has_before && sum[1] == 0) seen.not_mine.push_back(fault);
            if (!is_now && sum[0] == 0) seen.missing.push_back(fault);
        }
    });
}

}  // namespace

Verification verify(const GhostPlan& plan, const Points& points, const VerifyOptions& options,
                    Participant& self) {
    const bool is_given = detail::CutoffAccess::of_all(options.cutoff) ||
                          detail::CutoffAccess::of_each(options.cutoff);
    const Cutoff of_plan = plan.cutoff ? Cutoff(*plan.cutoff) : Cutoff();
    const Cutoff& cutoff = is_given ? options.cutoff : of_plan;
    VerifyRequest request{plan, points, options, Radii::of_cutoff(cutoff, plan.needs, points.count),
                          PeriodicImages(plan.periodic.value_or(Box{}), points.dimension)};
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
        std::ssize(seen.missing) + std::ssize(seen.duplicates) + std::ssize(seen.not_mine)};
    agree(self);
    self.check(MPI_Allreduce(MPI_IN_PLACE, totals.data(), 2, MPI_INT64_T, MPI_SUM, self.comm),
               "MPI_Allreduce");
    seen.num_pairs = totals[0];
    seen.num_faults = totals[1];
    return seen;
}

Verification verify(const GhostPlan& plan, const Points& points, MPI_Comm user,
                    const VerifyOptions& options) {
    Participant self = mpi::enter(user, CallName::verify);
    Verification seen = verify(plan, points, options, self);
    self.throw_alone();
    return seen;
}

}  // namespace rrcb::experimental
