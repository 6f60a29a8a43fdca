#pragma once

#include "collective/agreement_mpi.hpp"
#include "gather/contribution.hpp"
#include "gather/kept_tree.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/method/bisection.hpp>

#include <mpi.h>

#include <array>
#include <limits>

namespace rrcb {

inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

inline bool is_known(double imbalance) {
    return imbalance == imbalance;
}

/// Verdict of the root, which it tells first: whether there are cuts, and the totals.
struct Verdict {
    std::int32_t failing_rank = no_rank;
    std::int32_t keeps = 0;    ///< 1: the points are kept
    double heaviest = 0;       ///< weight of the heaviest point, 1 by count
    double common_weight = 0;  ///< weight of each point where all weigh the same, else 0
    std::int64_t num_points = 0;
    std::int64_t num_records = 0;
    double total_weight = 0;
    double estimated_imbalance = 1;
    Box box{};                              ///< of all points, where cells were gathered
    double kept_imbalance = not_known;      ///< of the parts that the ranks hold, where they do
    double measured_imbalance = not_known;  ///< of the parts of earlier cuts, where all counted
};

/// What every rank expects of the root first, whatever it was asked for: the verdict, and as much
/// of the decision as fits behind it.
using Head = std::array<std::byte, 2048>;

/// The decision of the root: how it went, and the cuts to assign by or to start from.
struct Decision {
    Verdict verdict;
    Bisection bisection;
    KeptTree kept{};                     ///< on all ranks once they were told that these stay
    bool reuses = false;                 ///< the cuts are earlier ones, which all ranks have
    std::vector<double> part_weights{};  ///< of the parts of these, where all counted
    std::vector<std::byte> message;      ///< either of them on its way
};

/// Report on a partition that nobody has measured. No sizes stand for equal ones.
Report report_of(const Verdict& verdict, int num_parts, std::span<const double> part_sizes);

/// Adds how even the parts are, as counted.
void report_measured(double imbalance, double tolerance, Report& report);

/// Weight of all points, or their number if they are balanced by that.
double weight_of(const Report& report);

/// True when the cuts are to be moved by what the ranks count.
bool is_refined(const Options& options);

/// Makes buffers for what the root will send: the kept parts only if it may read them. Not
/// collective.
void make_buffers(Decision& decision, const Options& options, int dimension, bool may_keep);

/// True when the parts of earlier cuts are counted: they may be good enough, and the cuts lie where
/// they may.
bool counts_earlier_parts(const Options& options);

/// The same where earlier cuts are the decision, unless their parts turn out too uneven: takes the
/// cuts, as the options ask for them. Not collective.
void make_buffers_to_reuse(Decision& decision, const Options& options, const Cuts& previous);

/// Bisects, at the root, what the ranks contributed; or looks at what they counted by earlier cuts.
/// Finds out whether the parts that the ranks hold are so good that the points are kept. Throws
/// Error when the ranks do not fit together.
void decide(const Contribution& all, const Options& options, Decision& decision);

/// Gives everybody the root's decision, or throws everywhere why there is none. Collective.
///
/// One message for a few dozen cuts, two for more: the first must be as long on a rank that does
/// not know how many are coming.
void broadcast(Decision& decision, const Participant& self);

/// Decides at the root, and brings its decision to every rank, or throws on all what failed on one.
/// Collective.
void decide_together(const Contribution& all, const Options& options, Decision& decision,
                     Participant& self);

/// Smallest box that holds those of all ranks. Collective.
Box box_together(Box box, const Participant& self);

/// Gives everybody the parts that the root has read: the points are kept after all. Collective.
void broadcast_kept(Decision& decision, const Participant& self);

}  // namespace rrcb
