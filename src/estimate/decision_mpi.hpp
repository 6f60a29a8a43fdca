#pragma once

#include "collective/agreement_mpi.hpp"
#include "collective/merge_tree.hpp"
#include "collective/participant.hpp"
#include "collective/stage_scope.hpp"
#include "estimate/contribution.hpp"
#include "estimate/kept_tree.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/method/bisection.hpp>

#include <limits>
#include <optional>

namespace rrcb {

/// Imbalance of parts neither counted nor estimated.
inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Imbalance of the ranks' present parts, if they cannot be kept.
inline constexpr double not_kept = std::numeric_limits<double>::infinity();

/// What rank 0 decides on.
enum class Answer : std::int32_t {
    cuts,     ///< it makes the cuts
    weights,  ///< of the parts of earlier cuts, which all ranks have
    totals,   ///< of all points only: many ranks make the parts
    kept      ///< the points are kept
};

/// Beginning of the decision of rank 0: its kind, and the totals of all ranks.
struct Verdict : Totals {
    std::int32_t failing_rank = no_rank;
    Answer answer = Answer::cuts;
    double estimated_imbalance = not_known;
    double kept_imbalance = not_kept;       ///< of the ranks' present parts
    double measured_imbalance = not_known;  ///< of the parts of earlier cuts
    std::int32_t may_turn = 0;              ///< 1: other cuts seem to have fewer points near them
    double turned_imbalance = not_known;    ///< estimated of those
    std::int32_t has_numbers = 0;           ///< 1: parts have other numbers than before
    double debt = 0;                        ///< of the cuts

    /// Returns true if points are counted, because all have the same weight or none.
    bool is_counted() const { return weight == 0 || lightest == heaviest; }
    /// Returns the weight of a counted point.
    double unit() const { return weight == 0 ? 1 : heaviest; }
    /// Returns the weight of all points, or their number if they are counted.
    double balanced_weight() const {
        return is_counted() ? static_cast<double>(num_points) : weight;
    }
    /// Returns the weight of the heaviest point, 1 if they are counted.
    double balanced_heaviest() const { return is_counted() ? 1 : heaviest; }
};

/// Decision of rank 0: a verdict, and the arrays of its answer.
///
/// The verdict determines which arrays are filled:
/// cuts:    the cuts, with brackets if they may move. If the parts that the ranks hold may be kept,
///          their weights, and perhaps cuts across other axes. After a turn, numbers of the parts
/// weights: the weights of the parts of `cuts`, which all ranks have
/// totals:  no array
/// kept:    the cuts, and the weights and parts of the ranks' points. Numbers as above, if they
///          were not sent before
struct Decision {
    Verdict verdict;
    Cuts cuts{};                         ///< to assign by, or to start from
    std::vector<Bracket> brackets{};     ///< one per movable cut
    std::vector<double> part_weights{};  ///< counted, or of the ranks' present parts
    std::vector<Part> parts{};           ///< of each rank's points
    Bisection turned{};                  ///< cuts across other axes than `cuts`, if these may turn
    std::optional<KeptTree> held{};  ///< the present parts, only on rank 0 and if they may be kept
    const Cuts* earlier = nullptr;   ///< whose axes are preferred; null: none
    std::vector<Part> numbers{};     ///< of the ends of the cuts that turned
    std::vector<std::byte> message{};  ///< verdict and arrays, as sent
};

/// Throws Error if the ranks differ or one has failed.
void check_together(const Summary& summary);

/// Returns the totals, and the imbalance of estimated parts, if there are any.
Verdict verdict_of(const Summary& summary, std::span<const double> estimated,
                   std::span<const double> part_sizes);

/// Returns the report on an unmeasured partition. Empty sizes: equal parts.
Report report_of(const Verdict& verdict, int num_parts, std::span<const double> part_sizes);

/// Gives the weights of parts the unit of the points, and the user's order. Not collective.
void finish_weights(const Verdict& verdict, const Cuts& cuts, std::vector<double>& weights);

/// Adds the counted imbalance.
void report_measured(double imbalance, double tolerance, Report& report);

/// Makes buffers for the decision; for kept parts only if rank 0 may read them. Not collective.
void make_buffers(Decision& decision, const Options& options, int dimension, bool may_keep);

/// Takes earlier cuts, fitted to the options, as the decision, with buffers for the weights of
/// their parts, which rank 0 compares. Not collective.
void take_earlier(Decision& decision, const Options& options, const Cuts& previous);

/// Sends the contributions of all ranks to rank 0, merged on the way. Collective.
///
/// A rank that failed, before or here, sends its number instead of records. A later failure is held
/// back until the next agreement.
void merge_up(Contribution& mine, int dimension, const MergeTree& tree, std::size_t most,
              Participant& self);

/// Bisects the cells of all ranks on rank 0, or weighs the parts of earlier cuts. Determines
/// whether the ranks already hold parts good enough to be kept. Throws Error if the ranks differ or
/// one has failed.
void decide(const Contribution& all, const Options& options, Decision& decision);

/// Sends the decision of rank 0 to all ranks, or throws the error of one rank on all. Collective.
///
/// One message for a few dozen cuts, two for more: the first has a fixed length, because the other
/// ranks do not know how many are coming.
void broadcast(Decision& decision, Participant& self);

/// Decides on rank 0 by decide(), and sends every rank the decision as broadcast(). Collective.
template <class Decide>
void decide_together(const Contribution& all, StageObserver* observer, Decision& decision,
                     Participant& self, Decide&& decide) {
    if (mpi::rank_of(self.comm) == root) {
        self.hear_of(all.summary.failing_rank);
        self.attempt([&] {
            const StageScope stage(observer, Stage::bisection, self.arithmetic);
            decide();
        });
        decision.verdict.failing_rank = self.failing_rank();
    }
    const StageScope stage(observer, Stage::broadcast, self.arithmetic);
    broadcast(decision, self);
}

/// Sends the parts read by the root to all ranks: the points are kept after all. Collective.
void broadcast_kept(Decision& decision, const Participant& self);

}  // namespace rrcb
