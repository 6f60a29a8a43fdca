#pragma once

#include "cells/sorted_points.hpp"
#include "collective/butterfly.hpp"
#include "refinement/fragments.hpp"
#include "refinement/local_search.hpp"
#include "refinement/target_rule.hpp"

#include <rrcb/cuts.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Number of a node or a part, in preorder.
inline Key key_of(const Descent& at) {
    constexpr Key shift = 32;
    return (static_cast<Key>(at.first_part) << shift) + std::numeric_limits<std::uint32_t>::max() -
           static_cast<Key>(at.num_parts);
}

/// What the parts below the regions are to be; the same on every rank.
struct RegionTree {
    int num_parts = 1;
    int num_ranks = 1;
    double weight = 0;                     ///< of all points
    std::span<const double> part_sizes{};  ///< one per part; empty: equal
    std::span<const int> cut_axes{};       ///< of all cuts in preorder; empty: free
    std::span<const double> ones{};        ///< as many as a region has equal parts; empty: made
    TargetRule rule{};                     ///< but for the sizes, and the weight per size
    double share_of_longest = 1;           ///< see longest_axis()
    bool plain_cuts = false;
    bool divides_coincident = false;  ///< points that no cut tells apart, see Coincident

    /// The rank that decides on the cut of a node: the first that holds its first part.
    int owner_of(const Descent& at) const;
};

/// Regions that a tree begins with, their number a power of two; the same on every rank.
struct Regions {
    Cuts cuts{};                        ///< between them
    std::span<const double> weights{};  ///< over all ranks
    Box box{};                          ///< of all points
    int num_coincident = 0;             ///< cuts between them with points that the target divides
};

/// One rank's part in the search for the cuts below the regions.
///
/// It takes part in a node of the tree in which it has points, or where one of its own parts lies.
/// The owner of the node decides, by what those ranks tell it, and answers them: these alone know
/// the cut. Nodes do not wait for others on their level. In a round each rank asks, the butterfly
/// carries that to the owners, they decide, it carries their answers back, and each rank follows.
/// All rounds of all ranks are over once none is_searching().
///
/// Memory and messages follow from the nodes that a rank takes part in, about 1.2 kB a node, and
/// at the owner up to 1024 positions and weights. Where points in one place are divided, a number
/// and a weight of each rank that has some come to the owner. Not collective.
class RegionSearch {
  public:
    /// Starts below the regions; `parts` and what `tree` refers to are borrowed. Where a cut
    /// between regions divides points in one place, `parts` tells on which side they are, by the
    /// numbers that parts there have in the whole tree. Throws std::bad_alloc.
    RegionSearch(const RegionTree& tree, int rank, const Regions& regions, SortedPoints&& points,
                 std::span<Part> parts);
    RegionSearch(const RegionSearch&) = delete;
    RegionSearch& operator=(const RegionSearch&) = delete;

    bool is_searching() const { return !nodes_.empty(); }

    /// Adds what this rank has in the nodes that are searched. Throws std::bad_alloc.
    void ask(Butterfly& butterfly) const;

    /// Decides on the nodes that this rank owns. Throws std::bad_alloc.
    void decide(Butterfly& butterfly);

    /// Follows the decisions, and writes the parts that are complete. A node without an answer,
    /// which a failure has lost, stays as it is. Throws std::bad_alloc.
    void follow(const Butterfly& butterfly);

    /// What records of a node make together; see Butterfly::Join.
    static void join(std::span<const double> a, std::span<const double> b,
                     std::vector<double>& joined);

    /// The cuts that this rank knows, with their numbers, which may be all. Throws std::bad_alloc.
    Cuts cuts() const;

    /// Of the parts that this rank owns; 0 where these are empty.
    double imbalance() const { return imbalance_; }

    /// Cuts that this rank decided on with points in one place that the target divides.
    int num_coincident() const { return num_coincident_; }

    /// The points, for another search; this one is over. They are in the order of their cells.
    SortedPoints take_points() { return std::move(points_); }

  private:
    /// What ranks tell of a node, where they have any of its points, begins with a mark: a
    /// histogram, each of the candidates, or what points at the cut weigh.
    static constexpr double mark_of_histogram = 0;
    static constexpr double mark_of_candidate = 1;
    static constexpr double mark_of_weight = 2;

    /// What is in a node.
    struct Content {
        std::vector<Fragment> fragments;
        Box box;                 ///< that holds its points on all ranks
        double weight = 0;       ///< over all ranks
        bool is_counted = true;  ///< false where the weight is off by a part of a point's
    };

    /// Node that is searched, or a part that is weighed.
    struct Node {
        Descent at;
        Content content;
        CutSearch search;
        LocalSearch local;
        CutTarget target{};        ///< at the owner only
        bool divides_lot = false;  ///< the cut is known, and who has what of the lot at it is asked
    };

    using Halves = std::pair<std::vector<Fragment>, std::vector<Fragment>>;

    struct KnownCut {
        std::size_t node;
        Cut cut;
    };

    /// What an owner tells of a node; where the search was sampling, the sample follows.
    struct Answer {
        CutSearch search;
        Box box;
        double weight = 0;
        double dividing_rank =
            0;                  ///< where a lot is divided: those before it have theirs below, ...
        double lot_before = 0;  ///< ... which weighs this much, and those after it above

        static constexpr std::size_t length() { return sizeof(Answer) / sizeof(double); }
    };

    double share_below(const Descent& at) const;
    std::span<const double> sizes_of(const Descent& at) const;
    CutTarget target_of(const Descent& at, double weight) const;
    double ideal_share(const Descent& part) const;
    bool is_tiny(const Descent& part) const;
    bool holds_own_parts(const Descent& at) const;
    void enter_region(const Regions& regions, const Descent& region, const Descent& at,
                      std::vector<Fragment>&& fragments, const Box& box);
    void enter(const Descent& at, Content&& content);
    void divide(const Descent& at, const Content& content, const Cut& cut, const Lot& lot,
                double below);
    Halves split_tightly(const std::vector<Fragment>& fragments, const Cut& cut, const Lot& lot);
    Halves split_by_parts(const std::vector<Fragment>& fragments, Part first_above);
    void end_at_cut(const Node& node, const Answer& answer);
    void end_at_part(const Descent& at, const Content& content);
    CutSearch first_search(const Descent& at, const Box& box, double weight) const;
    std::vector<double> answer_to(const Record& record, Node& node);
    void place_weights(const Node& node, std::span<const double> payload, Answer& answer) const;
    void count(const Node& node, std::vector<double>& payload) const;
    CutSearch decide_on(Node& node, std::span<const double> payload);
    void decide_among_candidates(const Node& node, std::span<const double> payload,
                                 CutSearch& search) const;
    void decide_by_first_count(Node& node, std::span<const double> histogram, CutSearch& search);
    void follow(Node&& node, std::span<const double> payload);

    RegionTree tree_;
    int rank_;
    int dimension_;
    Part first_own_ = 0;        ///< of the parts that this rank holds ...
    Part end_own_ = 0;          ///< ... the first, and the one behind the last
    double all_sizes_ = 0;      ///< sum of the sizes of all parts
    std::vector<double> ones_;  ///< sizes of the parts of a region, see sizes_of()
    HistogramLayout layout_;
    SortedPoints points_;
    std::span<Part> parts_;
    std::vector<Node> nodes_;  ///< ascending
    std::vector<KnownCut> known_;
    double imbalance_ = 0;
    int num_coincident_ = 0;
};

}  // namespace rrcb
