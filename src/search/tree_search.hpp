#pragma once

#include "collective/butterfly.hpp"
#include "cuts/cut_limits.hpp"
#include "passes/open_points.hpp"
#include "search/cut_search.hpp"
#include "search/target_rule.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/detail/bisection.hpp>
#include <rrcb/detail/statistical_domain.hpp>

#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Returns the key of a node or a part. Keys ascend in preorder.
inline Key key_of(const Descent& at) {
    constexpr Key shift = 32;
    return (static_cast<Key>(at.first_part) << shift) + std::numeric_limits<std::uint32_t>::max() -
           static_cast<Key>(at.num_parts);
}

/// The parts to make. All values are the same on every rank.
struct PartTree {
    int dimension = 0;
    int num_parts = 1;
    int num_owners = 1;  ///< number of ranks that own nodes; 1: rank 0 owns all of them
    TreeShape shape{};
    double weight = 0;  ///< weight of all points
    Box box{};          ///< box of all points; if cuts are limited, the region of the cuts
    std::span<const int> cut_axes{};  ///< axes of all cuts in preorder; empty: free
    std::span<const int> axes{};      ///< axes that free cuts may cross
    bool crosses_longest = false;     ///< in a spread search, whether free cuts cross the longest
                                      ///< axis; otherwise they minimize ghosts
    TargetRule rule{};
    bool plain_cuts = false;
    /// Whether cuts are moved to the middle between the points of all ranks.
    bool centres_cuts = false;
    bool divides_coincident = false;  ///< whether cuts may divide coincident points, see Coincident
    std::array<AxisLimits, max_dimension> limits{};  ///< only in a central search
};

/// Cuts from which a search starts. All values except the box are the same on every rank.
struct Guide {
    Cuts& cuts;                         ///< the search moves these cuts, but keeps their axes
    std::span<const Bracket> brackets;  ///< intervals in which the cuts are searched first
    CutLimits* limits;                  ///< null if cuts are not limited
    /// Weights of the parts that the cuts make, if they were counted.
    std::span<const double> sums;
    bool is_counted;  ///< whether the sums belong to these cuts
    Box box;          ///< contains the points of this rank
};

/// Returns intervals in which the cuts of a guide will most likely end.
///
/// If the weight below a cut was counted, its interval is wide enough for the weight that is
/// missing there. Limited cuts and cuts through few points get infinite intervals.
std::vector<Bracket> likely_intervals(const TargetRule& rule, const Guide& guide);

/// Searches for the cuts of a tree. This class is the part of one rank.
///
/// Each rank sends the owner of a node a summary of its points in the node; the owner decides on
/// the cut and answers. Nodes do not wait for other nodes of their level. Each round has five
/// steps: ask, a pass of the butterfly to the owners, decide, a pass back, follow. The search ends
/// when is_searching() is false on all ranks; then the open points have to be settled. No function
/// is collective.
///
/// Spread search: a rank takes part in a node if it has points in it or holds one of its parts. The
/// owner of a node is the first rank of its first part, and only ranks that take part know its cut.
/// Axes are free or given. Memory and messages are proportional to the number of nodes in which a
/// rank takes part: about 1.2 kB for each node, times the number of free axes in the node's first
/// count. Owners also store gathered positions and weights.
///
/// Central search: rank 0 owns all nodes, and all ranks take part in each. Cuts start from a Guide,
/// which fixes their axes, and may be limited. If the parts of a node were counted and are good
/// enough, its cuts are kept.
class TreeSearch {
  public:
    /// Starts a search of this rank's open points. Without a guide the search is spread, with a
    /// guide it is central and its rule must have part sizes. All arguments are borrowed, including
    /// the spans of `tree`. Throws std::bad_alloc.
    TreeSearch(const PartTree& tree, int rank, OpenPoints& open, const Guide* guide = nullptr);
    TreeSearch(const TreeSearch&) = delete;
    TreeSearch& operator=(const TreeSearch&) = delete;

    bool is_searching() const { return !nodes_.empty(); }

    /// Adds this rank's records about the nodes in search. Throws std::bad_alloc.
    void ask(Butterfly& butterfly);

    /// Decides on the nodes that this rank owns. Throws std::bad_alloc.
    void decide(Butterfly& butterfly);

    /// Processes the decisions. A node is left unchanged if its answer is missing after a failure.
    /// Throws std::bad_alloc.
    void follow(const Butterfly& butterfly);

    /// Joins two records of a node; see Butterfly::Join.
    static void join(std::span<const double> a, std::span<const double> b,
                     std::vector<double>& joined);

    /// After a spread search, returns the tree with this rank's own cuts; those of other ranks are
    /// zero. `numbers` are the numbers of the parts, see Cuts. Throws std::bad_alloc.
    Cuts own_cuts(std::vector<Part> numbers = {}) const;

    /// In a spread search, returns the imbalance of the parts that this rank owns; 0 if these are
    /// empty.
    double imbalance() const { return imbalance_; }

    /// Returns the number of cuts at which the target is among coincident points. A central search
    /// counts all cuts, a spread search only the cuts that this rank owns.
    int num_coincident() const { return num_coincident_; }

  private:
    /// Kinds of records about a node, which are the first entry of the record: a histogram, the
    /// candidates, the weights of ranks, or the gap around the cut.
    static constexpr double mark_of_histogram = 0;
    static constexpr double mark_of_candidates = 1;
    static constexpr double mark_of_weights = 2;
    static constexpr double mark_of_gap = 3;

    /// Points of one rank in a lot. For a part only the weight is used.
    struct LotRecord {
        double rank = 0;
        PointsInLot points{};
    };
    /// Division of a lot: the points of ranks before the dividing rank are below the cut, those of
    /// ranks after it above.
    struct LotAnswer {
        double dividing_rank = 0;
        double before = 0;  ///< weight of the lot on the ranks before it
    };

    /// A node whose cut is searched, or a part that is weighed.
    struct Node {
        Descent at;
        Box box{};                       ///< contains the node's points of all ranks, see PartTree
        double weight = 0;               ///< sum over all ranks
        bool is_counted = true;          ///< false if the weight may be wrong by up to one point
        bool are_parts_counted = false;  ///< whether the guide's sums contain the weights of its
                                         ///< parts
        CutSearch search{};
        Total settled_below{};  ///< points of this rank below the interval of the cut
        Total settled_above{};  ///< points of this rank above the interval
        Gap gap{};              ///< used while the cut is centred
        bool is_wider = false;  ///< whether the cut has left its interval
        bool is_taken = false;  ///< whether the owner gathers all points, without a count
        Box found{};            ///< only at the owner, after the first count: box of the points
        CutTarget target{};     ///< only at the owner
        LotAnswer lot{};        ///< only at the owner
        Places places{};        ///< allowed positions of the cut
    };

    /// Answer of an owner. In a spread search, the box of the node follows after its first count; a
    /// LotAnswer follows if the cut divides a lot.
    struct Answer {
        CutSearch search;
        double weight = 0;
    };

    int owner_of(const Descent& at) const;
    bool takes_part(const Descent& at) const;
    double ideal_share(const Descent& part) const;
    bool is_tiny(const Descent& part) const;
    void enter(Node&& node);
    bool ends_at(Node& node);
    void add_node(Node&& entered);
    Cut cut_unsearched(const Node& node, double share) const;
    void divide(Node&& node, const Cut& cut, const Lot& lot, double below);
    void note(const Descent& at, const Cut& cut);
    void end_at_cut(Node&& node, const LotAnswer& told);
    void weigh_part(const Node& node);
    CutSearch search_across(int axis, const Bracket& bracket, double weight) const;
    CutSearch search_in_box(const Node& node) const;
    CutSearch search_from_guide(Node& node) const;
    static void turn(CutSearch& search, const Box& box, int axis);
    bool counts_all_axes(const Node& node) const;
    void count_other_axes(const Node& node, std::vector<double>& payload) const;
    std::vector<double> choose_axis(const Node& node, std::span<const double> histogram,
                                    CutSearch& search) const;
    std::size_t fewest_near(std::span<const StatisticalDomain> along, const Node& node,
                            std::size_t longest, double num_points) const;
    bool has_points(const Node& node) const;
    void count(const Node& node, std::vector<double>& payload) const;
    bool is_taken_at_once(const Node& node) const;
    void aim(Node& node, GlobalCount count) const;
    void frame(std::span<const double> candidates, CutSearch& search) const;
    void add_lot(const Node& node, std::vector<double>& payload) const;
    void count_points(const Node& node, std::span<double> histogram) const;
    void keep_chosen(const CutSearch& before, Node& node);
    void widen();
    std::vector<double> answer_to(const Record& record, const Node& node,
                                  const CutSearch& decided) const;
    Lot lot_at(const Descent& at, const CutSearch& search) const;
    CutSearch decide_on_lot(Node& node, std::span<const double> payload) const;
    CutSearch decide_on(Node& node, std::span<const double> payload);
    void decide_by_first_count(Node& node, std::span<const double> histogram, CutSearch& search);
    void follow(Node&& node, std::span<const double> payload);
    void follow_search(Node&& node, const CutSearch& next, std::span<const double> more);

    PartTree tree_;
    const Guide* guide_;  ///< null in a spread search
    int rank_;
    Part first_own_ = 0;    ///< first part of this rank
    Part end_own_ = 0;      ///< end of the range of this rank's parts
    double all_sizes_ = 0;  ///< sum of the sizes of all parts
    HistogramLayout layout_;
    OpenPoints& open_;
    std::deque<Node> nodes_;  ///< ascending; a deque, because it frees memory while it is processed
    std::vector<std::pair<std::size_t, Cut>> own_;  ///< the cuts that this rank owns and has found,
                                                    ///< in a spread search
    double imbalance_ = 0;
    int num_coincident_ = 0;
};

}  // namespace rrcb
