#pragma once

#include "collective/agreement_mpi.hpp"
#include "collective/merge_tree.hpp"
#include "collective/participant.hpp"
#include "estimate/contribution.hpp"
#include "estimate/kept_tree.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/detail/bisection.hpp>

#include <limits>
#include <optional>

namespace rrcb {

/// Imbalance of parts that were neither counted nor estimated.
inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Imbalance of the parts that the ranks hold now, if these cannot be kept.
inline constexpr double not_kept = std::numeric_limits<double>::infinity();

/// Kind of rank 0's decision.
enum class Answer : std::int32_t {
    cuts,     ///< rank 0 has made the cuts
    weights,  ///< it has weighed the parts of earlier cuts, which all ranks have
    totals,   ///< it sends only totals of all points, because many ranks make the parts
    kept      ///< the points remain where they are
};

/// Beginning of rank 0's decision: its kind, and the totals of all ranks.
struct Verdict : Totals {
    std::int32_t failing_rank = no_rank;
    Answer answer = Answer::cuts;
    double estimated_imbalance = not_known;
    double kept_imbalance = not_kept;       ///< imbalance of the parts that the ranks hold now
    double measured_imbalance = not_known;  ///< imbalance of the parts of earlier cuts
    std::int32_t may_turn = 0;  ///< 1: cuts across other axes seem to have fewer points near them
    double turned_imbalance = not_known;  ///< estimated imbalance of those cuts
    std::int32_t has_numbers = 0;         ///< 1: parts have other numbers than before
    double debt = 0;                      ///< debt of the cuts, see bisect_along()

    /// Returns true if points are counted, because all have the same weight or none.
    bool is_counted() const { return weight == 0 || lightest == heaviest; }
    /// Returns the weight of a counted point.
    double unit() const { return weight == 0 ? 1 : heaviest; }
    /// Returns the weight of all points, or their number if they are counted.
    double balanced_weight() const {
        return is_counted() ? static_cast<double>(num_points) : weight;
    }
    /// Returns the weight of the heaviest point; 1 if points are counted.
    double balanced_heaviest() const { return is_counted() ? 1 : heaviest; }
};

/// Decision of rank 0: a verdict, and the arrays that belong to its answer.
///
/// The answer determines which arrays are filled:
/// cuts:    the cuts, with brackets if they may move. If the parts that the ranks hold may be kept,
/// also
///          the weights of these parts, and possibly cuts across other axes. After a turn, also the
///          numbers of the parts
/// weights: the weights of the parts of `cuts`, which all ranks have
/// totals:  no array
/// kept:    the cuts, and the weights and parts of the ranks' points. Also the numbers of the
/// parts,
///          if they were not sent before
struct Decision {
    Verdict verdict;
    Cuts cuts{};                      ///< cuts to assign the points by, or to start a search from
    std::vector<Bracket> brackets{};  ///< one for each cut that may move
    std::vector<double> part_weights{};  ///< weights of the parts that were counted, or that the
                                         ///< ranks hold now
    std::vector<Part> parts{};           ///< part of each rank's points
    Bisection turned{};              ///< alternative cuts across other axes, if the cuts may turn
    std::optional<KeptTree> held{};  ///< the parts that the ranks hold now; only on rank 0, and if
                                     ///< they may be kept
    const Cuts* earlier = nullptr;   ///< earlier cuts whose axes are preferred, or null
    std::vector<Part> numbers{};     ///< numbers of the parts at the ends of the tree, after a turn
    std::vector<std::byte> message{};  ///< the verdict and the arrays, as sent
};

/// Throws Error if requests differ between ranks or a rank has failed.
void check_together(const Summary& summary);

/// Returns the totals and, if parts were estimated, the imbalance of these.
Verdict verdict_of(const Summary& summary, std::span<const double> estimated,
                   std::span<const double> part_sizes);

/// Returns the report on a partition that was not measured. Empty sizes mean equal parts.
Report report_of(const Verdict& verdict, int num_parts, std::span<const double> part_sizes);

/// Converts the weights of parts from counts to the unit of the points, and puts them in the order
/// of the parts' numbers. Not collective.
void finish_weights(const Verdict& verdict, const Cuts& cuts, std::vector<double>& weights);

/// Adds the measured imbalance to a report.
void report_measured(double imbalance, double tolerance, Report& report);

/// Makes the buffers of a decision. Those for kept parts are made only if `may_keep`. Not
/// collective.
void make_buffers(Decision& decision, const Options& options, int dimension, bool may_keep);

/// Makes earlier cuts the decision, fitted to the options, with buffers for the weights of their
/// parts, which rank 0 compares. Not collective.
void take_earlier(Decision& decision, const Options& options, const Cuts& previous);

/// Sends the contributions of all ranks to rank 0; they are merged on the way. Collective.
///
/// A rank that has failed, before or here, sends its number instead of records. A later failure is
/// held back until the next agreement.
void merge_up(Contribution& mine, int dimension, const MergeTree& tree, std::size_t most,
              Participant& self);

/// On rank 0, bisects the cells of all ranks, or weighs the parts of earlier cuts. Determines
/// whether the parts that the ranks hold now are good enough to be kept. Throws Error if requests
/// differ between ranks or a rank has failed.
void decide(const Contribution& all, const Options& options, Decision& decision);

/// Sends the decision of rank 0 to all ranks, or throws the error of one rank on all ranks.
/// Collective.
///
/// A few dozen cuts take one message, more take two: the first message has a fixed length, because
/// the other ranks do not know the number of cuts.
void broadcast(Decision& decision, Participant& self);

/// Calls decide() on rank 0, and sends every rank the decision by broadcast(). Collective.
template <class Decide>
void decide_together(const Contribution& all, Decision& decision, Participant& self,
                     Decide&& decide) {
    if (mpi::rank_of(self.comm) == root) {
        self.hear_of(all.summary.failing_rank);
        self.attempt(decide);
        decision.verdict.failing_rank = self.failing_rank();
    }
    broadcast(decision, self);
}

/// Sends the parts that the ranks hold to all ranks, because the points are kept after all.
/// Collective.
void broadcast_kept(Decision& decision, const Participant& self);

}  // namespace rrcb
