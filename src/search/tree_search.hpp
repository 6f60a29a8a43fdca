#pragma once

#include "collective/butterfly.hpp"
#include "cuts/cut_limits.hpp"
#include "passes/open_points.hpp"
#include "search/cut_search.hpp"
#include "search/target_rule.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/method/bisection.hpp>
#include <rrcb/method/statistical_domain.hpp>

#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Returns the number of a node or a part, in preorder.
inline Key key_of(const Descent& at) {
    constexpr Key shift = 32;
    return (static_cast<Key>(at.first_part) << shift) + std::numeric_limits<std::uint32_t>::max() -
           static_cast<Key>(at.num_parts);
}

/// The parts to make; the same on every rank.
struct PartTree {
    int dimension = 0;
    int num_parts = 1;
    int num_owners = 1;  ///< ranks that own nodes: 1 if rank 0 owns all of them
    TreeShape shape{};
    double weight = 0;                ///< of all points
    Box box{};                        ///< of all points; with limits the region of their cuts
    std::span<const int> cut_axes{};  ///< of all cuts in preorder; empty: free
    std::span<const int> axes{};      ///< of free cuts, which may cross any of them
    bool crosses_longest = false;     ///< of a spread search; else free cuts leave fewest ghosts
    TargetRule rule{};
    bool plain_cuts = false;
    bool centres_cuts = false;        ///< moves cuts to the middle between points of all ranks
    bool divides_coincident = false;  ///< divides coincident points, see Coincident
    std::array<AxisLimits, max_dimension> limits{};  ///< of a central search
};

/// Cuts to start from; the same on every rank, except the box.
struct Guide {
    Cuts& cuts;                         ///< the search moves them, but keeps their axes
    std::span<const Bracket> brackets;  ///< intervals in which the cuts are looked for first
    CutLimits* limits;                  ///< null if cuts are not limited
    std::span<const double> sums;       ///< of the parts by the cuts, if they were counted
    bool is_counted;                    ///< the sums belong to the cuts
    Box box;                            ///< of the points of this rank
};

/// Returns intervals in which the cuts of a guide end, most probably.
///
/// If the weight below a cut was counted, its interval is wide enough for what is missing there.
/// Limited cuts, and cuts of few points, may end anywhere.
std::vector<Bracket> likely_intervals(const TargetRule& rule, const Guide& guide);

/// One rank's part in the search for the cuts of a tree.
///
/// Each rank sends the owner of a node a summary of its points there; the owner decides on the cut
/// and answers. Nodes do not wait for others on their level. Each round has five steps: ask, a pass
/// of the butterfly to the owners, decide, a pass back, follow. The search ends when is_searching()
/// is false on all ranks; then the open points are to be settled. Not collective.
///
/// Spread: a rank takes part in a node if it has points in it or owns one of its parts. The first
/// rank of the first part owns the node, and only ranks that take part know the cut. Axes are free
/// or given. Memory and messages are in proportion to the nodes in which a rank takes part, about
/// 1.2 kB a node, times the free axes in its first count. Owners also hold gathered positions and
/// weights.
///
/// Central: rank 0 owns all nodes, in which all ranks take part. Cuts start from a Guide, which
/// fixes their axes, and may be limited. If the counted parts of a node are good enough, its cuts
/// are kept.
class TreeSearch {
  public:
    /// Starts a search of open points of this rank: a spread one without a guide, a central one
    /// with a guide, whose rule has part sizes. Everything is borrowed, also the spans of `tree`.
    /// Throws std::bad_alloc.
    TreeSearch(const PartTree& tree, int rank, OpenPoints& open, const Guide* guide = nullptr);
    TreeSearch(const TreeSearch&) = delete;
    TreeSearch& operator=(const TreeSearch&) = delete;

    bool is_searching() const { return !nodes_.empty(); }

    /// Adds the records of this rank for the searched nodes. Throws std::bad_alloc.
    void ask(Butterfly& butterfly);

    /// Decides on this rank's own nodes. Throws std::bad_alloc.
    void decide(Butterfly& butterfly);

    /// Follows the decisions. A node whose answer a failure has lost is left unchanged. Throws
    /// std::bad_alloc.
    void follow(const Butterfly& butterfly);

    /// Joins two records of a node; see Butterfly::Join.
    static void join(std::span<const double> a, std::span<const double> b,
                     std::vector<double>& joined);

    /// Returns the tree after a spread search, in which cuts of other ranks are zeros. Throws
    /// std::bad_alloc. `numbers` of its parts, see Cuts.
    Cuts own_cuts(std::vector<Part> numbers = {}) const;

    /// Returns the imbalance of the parts that this rank owns, in a spread search; 0 if these are
    /// empty.
    double imbalance() const { return imbalance_; }

    /// Returns the number of cuts with coincident points that the target divides: all in a central
    /// search, this rank's own in a spread one.
    int num_coincident() const { return num_coincident_; }

  private:
    /// First entry of a node's record from a rank with points there: it contains a histogram, the
    /// candidates, the weights of ranks, or the gap around the cut.
    static constexpr double mark_of_histogram = 0;
    static constexpr double mark_of_candidates = 1;
    static constexpr double mark_of_weights = 2;
    static constexpr double mark_of_gap = 3;

    /// Points of a rank in a lot, or in a part, of which only the weight counts.
    struct LotRecord {
        double rank = 0;
        PointsInLot points{};
    };
    /// Divides a lot: ranks before the dividing one have their points below, ranks after it above.
    struct LotAnswer {
        double dividing_rank = 0;
        double before = 0;  ///< weight on the ranks before it
    };

    /// A node to search, or a part to weigh.
    struct Node {
        Descent at;
        Box box{};                       ///< that contains the points of all ranks, see PartTree
        double weight = 0;               ///< over all ranks
        bool is_counted = true;          ///< false if the weight is wrong by up to a point
        bool are_parts_counted = false;  ///< the guide's sums contain its parts' weights
        CutSearch search{};
        Total settled_below{};  ///< points of this rank below the interval of the cut
        Total settled_above{};  ///< and above
        Gap gap{};              ///< while it is centred
        bool is_wider = false;  ///< the cut has left its interval
        bool is_taken = false;  ///< the owner gets all points, which were not counted
        Box found{};            ///< at the owner only: box of the points, once counted
        CutTarget target{};     ///< likewise
        LotAnswer lot{};        ///< likewise
        Places places{};        ///< allowed for the cut
    };

    /// Answer of an owner. A LotAnswer may follow it, and the box of the node after the first count
    /// of the node in a spread search.
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
    Part first_own_ = 0;    ///< first of the parts on this rank
    Part end_own_ = 0;      ///< the one behind the last
    double all_sizes_ = 0;  ///< sum of the sizes of all parts
    HistogramLayout layout_;
    OpenPoints& open_;
    std::deque<Node> nodes_;  ///< ascending; gives memory back as it is followed
    std::vector<std::pair<std::size_t, Cut>> own_;  ///< cuts of nodes that this rank owns, found
                                                    ///< by a spread search
    double imbalance_ = 0;
    int num_coincident_ = 0;
};

}  // namespace rrcb
