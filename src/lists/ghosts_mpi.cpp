#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/rank_counts_mpi.hpp"
#include "collective/rank_order.hpp"
#include "lists/delivery_mpi.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/periodic_images.hpp"
#include "lists/radii.hpp"
#include "lists/remap_mpi.hpp"
#include "lists/tier_search_mpi.hpp"
#include "lists/transfer_log.hpp"
#include "options/rejection.hpp"
#include "options/request.hpp"
#include "options/validation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace rrcb {

namespace {

/// The ranks that hold the part at each end of the tree: those that are given, or those of
/// ranks_of_part().
struct Holders {
    std::optional<std::span<const RankRange>> given;
    TreeShape shape;
    int num_parts;
    int rank;  ///< this one
    int num_ranks;

    RankRange of_part(Part part) const {
        return given ? (*given)[part] : ranks_of_part(part, num_parts, num_ranks);
    }

    RankRange operator()(Part end) const { return of_part(shape.part_at(end, num_parts)); }

    /// Returns the ends of the parts that only this rank holds, in ranges as long as possible.
    std::vector<PartRange> alone_here() const {
        PartRange among{0, num_parts};
        if (!given && shape.dealt == 0) among = parts_on(rank, num_parts, num_ranks);
        std::vector<PartRange> ranges;
        for (Part part = among.first; part < among.end; ++part) {
            const RankRange ranks = (*this)(part);
            if (ranks.first_rank != rank || ranks.count > 1) continue;
            if (ranges.empty() || ranges.back().end != part) ranges.push_back({part, part});
            ranges.back().end = part + 1;
        }
        return ranges;
    }

    /// Returns the ends of the parts that this rank holds.
    std::vector<Part> ends_here() const {
        std::vector<Part> ends;
        for (Part end = 0; end < num_parts; ++end)
            if ((*this)(end).contains(rank)) ends.push_back(end);
        return ends;
    }

    void check() const {
        if (!given) return;
        require(given->size() == static_cast<std::size_t>(num_parts),
                "ranks_of_parts must have one entry for each part");
        check_ranks(*given, num_ranks);
    }
};

/// Finds which of this rank's points other ranks need, by the cuts that are known.
class Neighbourhood {
  public:
    /// `has_balanced`: the points are those of the balance, which must have been transferred.
    Neighbourhood(const Cuts& cuts, const Holders& holders,
                  const std::optional<PeriodicImages>& images, const PartReaches* reaches,
                  bool has_balanced)
        : cuts_(cuts),
          has_balanced_(has_balanced),
          dimension_(cuts.dimension),
          holders_(holders),
          images_(images),
          alone_(holders.alone_here()),
          reach_(reaches != nullptr ? reaches->greatest() : -infinity),
          search_(cuts, alone_, reaches) {
        if (images_) search_of_images_.emplace(cuts, std::span<const PartRange>{}, reaches);
        if (alone_.size() != 1 || alone_[0].end - alone_[0].first != 1) return;
        const Part end = alone_[0].first;
        if (knows_path(cuts, end)) home_ = box_of(cuts, part_at(cuts, end));
    }

    /// Notes the ranks that need a point or its images. Points come in ascending order.
    void add(LocalIndex point, const Ball& ball) {
        if (!images_) return add(point, ball, Shift{});
        images_->for_each(ball.widened(reach_), [&](const Shift& shift, const Vector& centre) {
            add(point, ball.moved_to(centre), shift);
        });
    }

    void write(GhostPlan& plan) const {
        RankOrder order(ranks_, holders_.num_ranks);
        plan.send = order.counts();
        plan.send_indices.resize(points_.size());
        plan.shifts.resize(shifts_.size());
        order.for_each([&](std::size_t k, std::size_t place) {
            plan.send_indices[place] = points_[k];
            if (images_) plan.shifts[place] = shifts_[k];
        });
    }

    /// Returns the nodes near points whose cuts are not known.
    std::vector<std::size_t> lacking() const { return {lacking_.begin(), lacking_.end()}; }

  private:
    void add(LocalIndex point, const Ball& ball, const Shift& shift) {
        const bool is_image = shift != Shift{};
        if (!is_image && home_ && ball.widened(reach_).is_inside(*home_, dimension_)) return;
        if (!is_image && has_balanced_) require_here(point, ball.centre());
        const auto first = std::ssize(ranks_);
        (is_image ? *search_of_images_ : search_)
            .for_each_part(
                ball, [&](Part end) { note(holders_(end), is_image); },
                [&](std::size_t node) { lacking_.insert(node); },
                is_image ? images_->apart(ball.centre()) : Vector{});
        // A rank may hold several of the parts.
        std::ranges::sort(ranks_.begin() + first, ranks_.end());
        ranks_.erase(std::unique(ranks_.begin() + first, ranks_.end()), ranks_.end());
        points_.resize(ranks_.size(), point);
        if (images_) shifts_.resize(ranks_.size(), shift);
    }

    void require_here(LocalIndex point, const Vector& position) const {
        const Part part = part_of(cuts_, position);
        if (part == no_part || holders_.of_part(part).contains(holders_.rank)) return;
        reject("these are the points of the balance, but point " + std::to_string(point) +
               " (the first is 0) has to leave this rank for part " + std::to_string(part) +
               "; give the points that the transfer returned");
    }

    void note(const RankRange& ranks, bool also_here) {
        for (int rank = ranks.first_rank; rank < ranks.first_rank + ranks.count; ++rank)
            if (also_here || rank != holders_.rank) ranks_.push_back(rank);
    }

    const Cuts& cuts_;
    bool has_balanced_;
    int dimension_;
    const Holders& holders_;
    const std::optional<PeriodicImages>& images_;
    std::vector<PartRange> alone_;
    double reach_;  ///< greatest of all parts
    BallSearch search_;
    std::optional<BallSearch> search_of_images_;  ///< of all parts
    std::optional<Box> home_;  ///< region of the only part that this rank does not share
    std::vector<LocalIndex> points_;
    std::vector<int> ranks_;     ///< each to get one of the points
    std::vector<Shift> shifts_;  ///< of these, if there are images
    std::set<std::size_t> lacking_;
};

/// Input of a plan on this rank.
struct GhostRequest {
    const Points& points;
    Radii radii;
    Holders holders;
    std::optional<PeriodicImages> images;
    bool has_balanced;                     ///< whether the points are those of the balance
    std::optional<PartReaches> reaches{};  ///< of the parts, if their radii count

    void check(const Cuts& cuts) const {
        radii.check(points.count);
        check_points(points);
        check_tree(cuts);
        require(cuts.dimension == points.dimension, "cuts must have the dimension of the points");
        holders.check();
        if (!images) return;
        images->check(radii.greatest());
        images->check(points);
    }

    /// Notes the reaches of the points of this rank. A point outside its parts counts for each.
    void note_reaches(const Cuts& cuts) {
        const std::vector<Part> ends = holders.ends_here();
        reaches.emplace(cuts.num_parts, cuts.dimension);
        const auto for_each_end = [&](LocalIndex i, auto&& visit) {
            const Part part = ends.size() > 1 ? part_of(cuts, points.position(i)) : no_part;
            const Part end = part == no_part ? no_part : end_of(cuts, part);
            if (std::ranges::binary_search(ends, end)) return visit(end);
            std::ranges::for_each(ends, visit);
        };
        for (LocalIndex i = 0; i < points.count; ++i)
            for_each_end(i, [&](Part end) { reaches->note_radius(end, radii.of(i)); });
        for (LocalIndex i = 0; i < points.count; ++i)
            for_each_end(
                i, [&](Part end) { reaches->note_place(end, radii.of(i), points.position(i)); });
    }

    /// Lists the points that this rank sends, with their shifts; returns the nodes whose cuts it
    /// lacks for the rest.
    std::vector<std::size_t> list_sent(const Cuts& cuts, GhostPlan& plan) const {
        Neighbourhood neighbourhood(cuts, holders, images, reaches ? &*reaches : nullptr,
                                    has_balanced);
        for (LocalIndex i = 0; i < points.count; ++i)
            neighbourhood.add(i, Ball(points.position(i), radii.of_sender(i)));
        plan.num_points = points.count;
        neighbourhood.write(plan);
        return neighbourhood.lacking();
    }
};

/// Search for the cuts that a plan lacks.
class GhostSearch : public TierSearch {
  public:
    GhostSearch(const Cuts& known, std::vector<std::size_t> lacking, const GhostRequest& request,
                GhostPlan& plan)
        : TierSearch(known), lacking_(std::move(lacking)), request_(request), plan_(plan) {}

    bool ask(Butterfly& asked) {
        TierSearch::ask(lacking_, asked);
        return !lacking_.empty();
    }

    void learn(const Butterfly& asked) {
        TierSearch::learn(asked);
        if (!lacking_.empty()) lacking_ = request_.list_sent(cuts(), plan_);
    }

  private:
    std::vector<std::size_t> lacking_;
    const GhostRequest& request_;
    GhostPlan& plan_;
};

/// Sends the shifts of ghosts to the ranks that get these. Collective.
void exchange_shifts(GhostPlan& plan, Participant& self) {
    const std::vector<Shift> sent = std::exchange(plan.shifts, {});
    Delivery delivery{.num_points = sent.size()};
    self.attempt([&] {
        delivery.to = plan.send;
        delivery.from = plan.receive;
    });
    const std::array columns{detail::byte_column(column(sent), plan.shifts)};
    deliver(delivery, columns, {}, nullptr, self);
}

/// Takes the greatest reaches of all ranks. Collective.
void join(PartReaches& reaches, Participant& self) {
    const std::span<double> numbers = reaches.numbers();
    self.check(MPI_Allreduce(MPI_IN_PLACE, numbers.data(), mpi::to_int(std::ssize(numbers)),
                             MPI_DOUBLE, MPI_MAX, self.comm),
               "MPI_Allreduce");
}

/// Collective; an earlier failure on one rank is thrown on all.
GhostPlan ghosts(const Cuts& cuts, GhostRequest& request, Participant& self) {
    GhostPlan plan;
    std::optional<SearchBuffers<GhostSearch>> buffers;
    std::uint64_t bits_of_cuts = 0;
    std::uint64_t bits_of_holders = 0;
    const auto list_sent = [&] {
        std::vector<std::size_t> lacking = request.list_sent(cuts, plan);
        if (!is_whole(cuts))
            buffers.emplace(GhostSearch(cuts, std::move(lacking), request, plan), self.comm);
    };
    self.attempt([&] {
        mpi::require_group(cuts.group, "the balance of the cuts", self);
        request.check(cuts);
        request.has_balanced = cuts.points == hash_of(request.points);
        request.radii.are_of_receivers() ? request.note_reaches(cuts) : list_sent();
        bits_of_cuts = bits_of(cuts);
        if (request.holders.given) bits_of_holders = hash_of(*request.holders.given);
    });
    plan.receive = exchange_counts(plan.send, self);
    agree(self, {{"the tree of cuts", bits_of_cuts},
                 request.radii.each_given(request.points.count),
                 request.radii.shared(),
                 {"needs", static_cast<std::uint64_t>(request.radii.needs)},
                 {"ranks_of_parts", bits_of_holders},
                 {"the periodic box", request.images ? request.images->hash() : 0}});
    if (request.reaches) {
        join(*request.reaches, self);
        self.attempt(list_sent);
        plan.receive = exchange_counts(plan.send, self);
        agree(self);
    }
    if (buffers && search_together(*buffers, self)) {
        plan.receive = exchange_counts(plan.send, self);
        agree(self);
    }
    if (request.images) exchange_shifts(plan, self);
    return plan;
}

}  // namespace

GhostPlan ghosts(const Cuts& cuts, const Points& points, const GhostOptions& options,
                 Participant& self) {
    GhostRequest request{points,
                         {options.radius, options.radii, options.needs},
                         {options.ranks_of_parts, cuts.shape, cuts.num_parts,
                          mpi::rank_of(self.comm), mpi::size_of(self.comm)},
                         {},
                         false};
    if (points.count == 0 && std::isnan(options.radius)) request.radii.each.emplace();
    if (options.periodic) request.images.emplace(*options.periodic, points.dimension);
    GhostPlan plan = ghosts(cuts, request, self);
    plan.group = self.group();
    plan.stamp = next_stamp();
    plan.radius = options.radius;
    plan.needs = options.needs;
    if (options.periodic) plan.periodic = *options.periodic;
    return plan;
}

GhostPlan ghosts(const Cuts& cuts, const Points& points, const GhostOptions& options,
                 MPI_Comm comm) {
    Participant self = mpi::enter(comm, CallName::ghosts);
    return ghosts(cuts, points, options, self);
}

}  // namespace rrcb
