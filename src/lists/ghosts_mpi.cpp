#include "collective/agreement_mpi.hpp"
#include "collective/attribute_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/rank_counts_mpi.hpp"
#include "collective/stamp_access.hpp"
#include "lists/delivery_mpi.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/near_boxes.hpp"
#include "lists/part_reaches.hpp"
#include "lists/periodic_images.hpp"
#include "lists/quiet_boxes.hpp"
#include "lists/radii.hpp"
#include "lists/rank_lists.hpp"
#include "lists/remap_mpi.hpp"
#include "lists/transfer_log.hpp"
#include "options/rejection.hpp"
#include "options/request.hpp"
#include "options/validation.hpp"
#include "passes/assignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace rrcb {

namespace {

/// The ranks that hold the part at each end of the tree: those given by the caller, or those of
/// ranks_of_part().
struct Holders {
    std::optional<std::span<const RankRange>> given;
    const Cuts& cuts;
    int rank;  ///< number of this rank
    int num_ranks;

    RankRange of_part(Part part) const {
        return given ? (*given)[part] : ranks_of_part(part, cuts.num_parts, num_ranks);
    }

    RankRange operator()(Part end) const { return of_part(cuts.part_at(end)); }

    /// Returns the ends of the tree whose parts this rank holds.
    std::vector<Part> ends_here() const {
        std::vector<Part> ends;
        for (Part end = 0; end < cuts.num_parts; ++end)
            if ((*this)(end).contains(rank)) ends.push_back(end);
        return ends;
    }

    void check() const {
        if (!given) return;
        require(given->size() == static_cast<std::size_t>(cuts.num_parts),
                "ranks_of_parts must have one entry for each part");
        check_ranks(*given, num_ranks);
    }
};

/// Input of a ghost plan on this rank.
struct GhostRequest {
    const Points& points;
    Radii radii;
    Holders holders;
    std::optional<PeriodicImages> images;
    Box box{};                             ///< of the points
    std::optional<PartReaches> reaches{};  ///< reaches of the parts, if parts need points within
                                           ///< radii of their own

    void check(const Cuts& cuts) {
        radii.check(points.count);
        box = check_points(points);
        check_tree(cuts);
        require(cuts.dimension == points.dimension, "cuts must have the dimension of the points");
        holders.check();
        if (!images) return;
        images->check(radii.greatest());
        images->check(points, box);
    }

    /// Notes the reaches of this rank's points. A point outside all parts of this rank counts for
    /// each of them.
    void note_reaches(const Cuts& cuts) {
        const std::vector<Part> ends = holders.ends_here();
        reaches.emplace(cuts.num_parts, cuts.dimension);
        if (points.count == 0) return;
        if (ends.size() == 1) return note_reaches(ends.front());
        std::vector<Part> of_points(points.count);
        assign_ends(cuts, points, of_points);
        const auto for_each_end = [&](LocalIndex i, auto&& visit) {
            if (std::ranges::binary_search(ends, of_points[i])) return visit(of_points[i]);
            std::ranges::for_each(ends, visit);
        };
        for (LocalIndex i = 0; i < points.count; ++i)
            for_each_end(i, [&](Part end) { reaches->note_radius(end, radii.of(i)); });
        for (LocalIndex i = 0; i < points.count; ++i)
            for_each_end(i, [&](Part end) { note_place(end, i); });
    }

  private:
    /// Notes the reaches of all points for a single part.
    void note_reaches(Part end) {
        reaches->note_radius(end, radii.greatest());
        if (!radii.each) return reaches->note_box(end, radii.same, box);
        for (LocalIndex i = 0; i < points.count; ++i) note_place(end, i);
    }

    void note_place(Part end, LocalIndex i) {
        const Vector x = points.position(i);
        reaches->note_box(end, radii.of(i), {x, x});
    }
};

/// Finds the points of this rank that other ranks need.
class Neighbourhood {
  public:
    /// The cuts and the request must outlive this object.
    Neighbourhood(const Cuts& cuts, const GhostRequest& request)
        : cuts_(cuts),
          request_(request),
          reach_(request.reaches ? request.reaches->greatest() : -infinity),
          near_(cuts, {request.holders, request.holders.rank, request.box, greatest_of_senders(),
                       images(), reaches()}),
          lists_(near_.ranks(), images() != nullptr) {}

    /// Lists the points that this rank sends, and their shifts.
    void list(GhostPlan& plan) {
        const double greatest = std::max(greatest_of_senders(), reach_);
        const QuietBoxes quiet(near_.homes(), greatest, cuts_.dimension, images());
        with_dimension([&](auto dimension) {
            quiet.for_each_outside(request_.points, [&](LocalIndex i) { add<dimension>(i); });
        });
        lists_.write(plan);
    }

  private:
    const PartReaches* reaches() const { return request_.reaches ? &*request_.reaches : nullptr; }
    const PeriodicImages* images() const { return request_.images ? &*request_.images : nullptr; }
    double greatest_of_senders() const {
        return request_.radii.needs == Needs::gather ? -infinity : request_.radii.greatest();
    }

    /// Calls visit with the dimension as a compile-time constant, so that loops over the axes are
    /// unrolled.
    template <class Visit>
    void with_dimension(Visit&& visit) const {
        if (cuts_.dimension == 1) return visit(std::integral_constant<int, 1>{});
        if (cuts_.dimension == 2) return visit(std::integral_constant<int, 2>{});
        visit(std::integral_constant<int, 3>{});
    }

    /// Notes the ranks that need a point or one of its images.
    template <int dimension>
    void add(LocalIndex point) {
        const Ball ball(request_.points.position(point), request_.radii.of_sender(point));
        if (!request_.images) return add<dimension>(point, ball, Shift{});
        request_.images->for_each(ball.widened(reach_),
                                  [&](const Shift& shift, const Vector& centre) {
                                      add<dimension>(point, ball.moved_to(centre), shift);
                                  });
    }

    template <int dimension>
    void add(LocalIndex point, const Ball& ball, const Shift& shift) {
        const bool is_image = shift != Shift{};
        if (!is_image && is_home_alone(ball)) return;
        lists_.begin(point, shift);
        near_.for_each_touched<dimension>(ball, [&](const NearBoxes::Row& row) {
            if (request_.reaches && !request_.reaches->reaches(row.end, ball)) return;
            for (std::int32_t slot = row.first_slot; slot < row.first_slot + row.num_slots; ++slot)
                if (is_image || lists_.rank_of(slot) != request_.holders.rank) lists_.add(slot);
        });
    }

    /// Returns true if no other rank can need a point: its ball is smaller than the largest and
    /// inside a box of this rank.
    bool is_home_alone(const Ball& ball) const {
        if (!request_.radii.each) return false;
        const Ball wide = ball.widened(reach_);
        return std::ranges::any_of(
            near_.homes(), [&](const Box& home) { return wide.is_inside(home, cuts_.dimension); });
    }

    const Cuts& cuts_;
    const GhostRequest& request_;
    double reach_;  ///< largest reach of all parts
    NearBoxes near_;
    RankLists lists_;
};

/// Sends the shifts of ghosts to the ranks that receive the ghosts. Collective.
void exchange_shifts(GhostPlan& plan, Participant& self) {
    const std::vector<Shift> sent = std::exchange(plan.shifts, {});
    const std::array columns{detail::byte_column(column(sent), plan.shifts)};
    deliver({.num_points = sent.size(), .to = plan.send, .from = plan.receive}, columns, {}, self);
}

/// Throws Error if the points are those of the balance, before their transfer. A transfer may leave
/// the hash unchanged, so points after such a transfer are accepted. If the caller gives the ranks
/// of the parts, nothing is known and nothing is refused.
void refuse_points_of_balance(const Cuts& cuts, const GhostRequest& request, MPI_Comm comm) {
    const std::uint64_t hash = detail::StampAccess::points(cuts.stamp);
    if (hash == 0 || request.holders.given || hash != hash_of(request.points)) return;
    const TransferLog* log = mpi::Attribute<TransferLog>::find(comm);
    if (log != nullptr && log->are_like_before(request.points.count)) return;
    reject(
        "these are the points of the balance, some of which have to leave this rank for their "
        "parts; give the points that the transfer returned");
}

/// Takes the maximum of each reach over the ranks. Collective.
void join(PartReaches& reaches, Participant& self) {
    const std::span<double> numbers = reaches.numbers();
    self.check(MPI_Allreduce(MPI_IN_PLACE, numbers.data(), mpi::to_int(std::ssize(numbers)),
                             MPI_DOUBLE, MPI_MAX, self.comm),
               "MPI_Allreduce");
}

/// Makes a ghost plan. Collective. If a rank has failed before, all ranks throw its error.
GhostPlan ghosts(const Cuts& cuts, GhostRequest& request, Participant& self) {
    GhostPlan plan;
    std::uint64_t bits_of_cuts = 0;
    std::uint64_t bits_of_holders = 0;
    const auto list = [&] {
        plan.num_points = request.points.count;
        Neighbourhood(cuts, request).list(plan);
    };
    self.attempt([&] {
        mpi::require_group(detail::StampAccess::ranks(cuts.stamp), "the balance of the cuts", self);
        request.check(cuts);
        refuse_points_of_balance(cuts, request, self.comm);
        request.radii.are_of_receivers() ? request.note_reaches(cuts) : list();
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
        self.attempt(list);
        plan.receive = exchange_counts(plan.send, self);
        agree(self);
    }
    if (request.images) exchange_shifts(plan, self);
    return plan;
}

}  // namespace

GhostPlan ghost_plan(const Cuts& cuts, const Points& points, const GhostOptions& options,
                     Participant& self) {
    GhostRequest request{
        points,
        Radii::of_cutoff(options.cutoff, options.needs, points.count),
        {options.ranks_of_parts, cuts, mpi::rank_of(self.comm), mpi::size_of(self.comm)},
        {}};
    if (options.periodic) request.images.emplace(*options.periodic, points.dimension);
    GhostPlan plan = ghosts(cuts, request, self);
    detail::StampAccess::ranks(plan.stamp) = self.group();
    detail::StampAccess::points(plan.stamp) = next_stamp();
    plan.cutoff = detail::CutoffAccess::of_all(options.cutoff);
    plan.needs = options.needs;
    plan.periodic = options.periodic;
    return plan;
}

GhostPlan ghost_plan(const Cuts& cuts, const Points& points, MPI_Comm comm,
                     const GhostOptions& options) {
    Participant self = mpi::enter(comm, CallName::ghost_plan);
    return ghost_plan(cuts, points, options, self);
}

}  // namespace rrcb
