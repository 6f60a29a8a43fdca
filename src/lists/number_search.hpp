#pragma once

#include "collective/butterfly.hpp"
#include "cuts/owned_cuts.hpp"

#include <rrcb/plan.hpp>
#include <rrcb/tree_shape.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

inline constexpr std::int32_t no_origin = -1;

/// Number of points from one origin, a rank or an earlier part, in a part. Points without a number
/// to keep them have no_origin.
struct Overlap {
    std::int32_t origin = no_origin;
    Part part = 0;
    GlobalCount count = 0;
};

/// Origins whose points are kept, and the searching ranks.
struct NumberRule {
    int num_parts = 1;
    int num_ranks = 1;
    bool by_rank = true;     ///< origins are ranks; else earlier parts
    bool is_spread = false;  ///< all ranks search; else rank 0 does
    /// Ranks of the parts, ascending; the first one of a part counts. Empty: as ranks_of_part().
    std::span<const RankRange> listed{};
    TreeShape shape{};  ///< of the tree; parts get the numbers of parts of their group

    /// Returns the origin whose points a part of this number keeps; numbers_of() is the inverse.
    std::int32_t home_of(Part number) const;
    PartRange numbers_of(std::int32_t origin) const;

    /// Returns whether the numbers for keeping the points of an origin are of the group of a part.
    bool is_in_group(Part part, std::int32_t origin) const {
        return shape.group_size == 1 || origin == no_origin ||
               group_of(origin) == group_of_part(part);
    }
    /// Returns the group of the numbers for keeping the points of an origin; -1 if there are
    /// several.
    int group_of(std::int32_t origin) const;
    int group_of_part(Part part) const { return shape.end_of(part, num_parts) / shape.group_size; }

    int searcher_of(Part part) const;
    int searcher_of_origin(std::int32_t origin) const {
        return is_spread && by_rank ? origin : searcher_of(origin);
    }

    /// Return the parts of a searching rank, and the numbers of its origins.
    PartRange parts_of(int rank) const;
    PartRange numbers_at(int rank) const {
        return is_spread && by_rank ? numbers_of(rank) : parts_of(rank);
    }
};

/// Search for numbers of the parts with many kept points: one rank's share, without the messages.
///
/// It finds the numbers of the greedy method: the largest overlap of all gets its number first,
/// which keeps at least half of the most points. Rounds of offers find them (D. Gale and L. S.
/// Shapley: College admissions and the stability of marriage, 1962). A part makes an offer to the
/// origin of its largest overlap, last of all to the origin of its present number. An origin
/// accepts the largest offers, as many as it has numbers. A refused part goes on to its next
/// origin, and asks the later ones which offers they would refuse. Overlaps have a total order, so
/// any distribution of the parts over the searching ranks gives the same numbers. Parts without a
/// number after the rounds are paired with unused numbers, both counted over the ranks.
///
/// Memory and messages grow with the overlaps of the rank's parts. Not collective. All functions
/// with a butterfly throw std::bad_alloc.
class NumberSearch {
  public:
    /// Throws std::bad_alloc.
    NumberSearch(const NumberRule& rule, int rank);

    const NumberRule& rule() const { return rule_; }

    /// Adds overlaps, ascending by part and origin, to be joined by add_up().
    void hand_in(std::span<const Overlap> overlaps, Butterfly& told) const;

    /// Begins with the overlaps of this rank's parts. The numbers are unchanged.
    void start(const Records& told);

    /// Adds the offers of this rank's parts, to be joined by append(). Returns whether any would
    /// change a number.
    bool offer(Butterfly& offers) const;

    /// Answers the offers to this rank's origins. Returns whether any was refused.
    bool choose(Butterfly& offers);

    /// Takes the numbers of accepted offers, and drops offers that were or would be refused.
    void follow(const Butterfly& offers);

    /// Parts without a number and unused numbers, of one rank or more.
    using Counts = std::array<std::int64_t, 2>;
    Counts left() const;

    /// Adds both, counted on from `before`, the counts of lower ranks; append() joins a part and a
    /// number with the same count. Each record is its own answer.
    void meet(const Counts& before, Butterfly& left) const;
    void take(const Counts& before, const Butterfly& left);

    /// Counts the points of this rank's parts: all, kept by the old numbers, kept by the new ones.
    std::array<GlobalCount, 3> count_points() const;

    /// Gives all parts their old numbers.
    void reset();

    /// Parts of this rank and their numbers.
    PartRange parts() const { return parts_; }
    std::span<const Part> numbers() const { return numbers_; }

    static void add_up(std::span<const double> a, std::span<const double> b,
                       std::vector<double>& joined);
    static void append(std::span<const double> a, std::span<const double> b,
                       std::vector<double>& joined);

  private:
    /// An origin to which a part offers its points in common, in its turn.
    struct Wish {
        double count = 0;                 ///< points in common; exact below 2^53
        bool keeps = false;               ///< the part would keep its present number
        std::int32_t origin = no_origin;  ///< gets the offer
        bool is_lost = false;             ///< the origin has refused it, or would
    };

    /// Count, whether the part keeps its number, and -part: larger ones win.
    using Offer = std::array<double, 3>;
    static Offer offer_of(const Wish& wish, Part part);
    void give_numbers(std::vector<Offer>& accepted, PartRange numbers, std::vector<double>& answer);

    bool is_here(Part part) const { return part >= parts_.first && part < parts_.end; }
    std::size_t index_of(Part part) const { return static_cast<std::size_t>(part - parts_.first); }
    Part part_at(std::size_t index) const { return parts_.first + static_cast<Part>(index); }

    NumberRule rule_;
    PartRange parts_;
    PartRange own_numbers_;
    GlobalCount num_points_ = 0;
    std::vector<std::vector<Wish>> wishes_;  ///< of each part
    std::vector<bool> was_refused_;          ///< each part, in the last round
    std::vector<Part> numbers_;              ///< of each part
    std::vector<bool> is_used_;              ///< each of own_numbers_
};

}  // namespace rrcb
