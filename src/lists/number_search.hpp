#pragma once

#include "collective/butterfly.hpp"
#include "cuts/owned_cuts.hpp"

#include <rrcb/plan.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

/// Number of points of one origin, a rank or an earlier part, that go to a part.
struct Overlap {
    std::int32_t origin = 0;
    Part part = 0;
    GlobalCount count = 0;
};

/// Where points are to be kept, and which ranks search for the numbers of the parts.
struct NumberRule {
    int num_parts = 1;
    int num_ranks = 1;
    bool by_rank = true;     ///< origins are ranks; else earlier parts
    bool is_spread = false;  ///< all ranks search; else rank 0 does
    /// Ranks of the parts, ascending; the first one of a part counts. Empty: as ranks_of_part().
    std::span<const RankRange> listed{};

    /// Origin whose points a part of this number keeps.
    std::int32_t home_of(Part number) const;

    /// Numbers of the parts that keep the points of an origin.
    PartRange numbers_of(std::int32_t origin) const;

    int searcher_of(Part part) const;
    int searcher_of_origin(std::int32_t origin) const {
        return is_spread && by_rank ? origin : searcher_of(origin);
    }

    /// Parts that a rank searches for, and the numbers of its origins.
    PartRange parts_of(int rank) const;
    PartRange numbers_at(int rank) const {
        return is_spread && by_rank ? numbers_of(rank) : parts_of(rank);
    }

    /// Overlaps that a rank hands in, the largest ones: 16 for each part per rank, and 65,536 of
    /// all ranks.
    std::size_t most_overlaps() const {
        return std::size_t{16} * static_cast<std::size_t>((num_parts - 1) / num_ranks + 1) +
               65536 / static_cast<std::size_t>(num_ranks);
    }
};

/// Search for numbers of the parts so that many points are kept: one rank's part in it, without the
/// messages.
///
/// The numbers are those of the greedy method: the largest overlap of all gets its number first,
/// which keeps at least half of the most that can be kept. Rounds of offers find them (D. Gale and
/// L. S. Shapley: College admissions and the stability of marriage, 1962). Each part makes an offer
/// to the origin of its largest overlap. An origin accepts the largest offers, as many as it has
/// numbers. A part that is refused offers to its next origin, and asks the later ones which offers
/// they would refuse. Overlaps have a total order, so the result does not depend on which rank
/// searches for which part. Last of all a part offers to the origin of its present number.
///
/// Parts without a number after the rounds are counted over the ranks, as are unused numbers; they
/// meet by their count.
///
/// Memory and messages grow with the overlaps that were handed in for the rank's parts. Not
/// collective. Functions that add to a butterfly or read from it throw std::bad_alloc.
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
    struct Counts {
        std::int64_t parts = 0;
        std::int64_t numbers = 0;
    };
    Counts left() const;

    /// Adds both, with `before` on the ranks before this one, to be joined by keep_larger().
    void meet(const Counts& before, Butterfly& left) const;

    /// Takes the numbers that parts met, after answer_all().
    void take(const Counts& before, const Butterfly& left);

    /// Points of this rank's parts that are kept under the old numbers and the new.
    struct Kept {
        GlobalCount before = 0;
        GlobalCount after = 0;
    };
    Kept kept() const;

    /// Leaves the numbers unchanged.
    void reset();

    PartRange parts() const { return parts_; }

    /// Numbers of this rank's parts.
    std::span<const Part> numbers() const { return numbers_; }

    static void add_up(std::span<const double> a, std::span<const double> b,
                       std::vector<double>& joined);
    static void append(std::span<const double> a, std::span<const double> b,
                       std::vector<double>& joined);
    static void keep_larger(std::span<const double> a, std::span<const double> b,
                            std::vector<double>& joined);

  private:
    /// An overlap of a part, in the order of its offers.
    struct Wish {
        double count = 0;  ///< exact below 2^53
        bool keeps = false;
        std::int32_t origin = 0;
        bool is_lost = false;  ///< the origin has larger offers
    };

    /// Count, whether the part keeps its number, and -part: larger ones win.
    using Offer = std::array<double, 3>;
    static Offer offer_of(const Wish& wish, Part part);
    static std::vector<Offer> offers_in(std::span<const double> payload);
    void give_numbers(std::vector<Offer>& accepted, PartRange numbers, std::vector<double>& answer);

    Part part_at(std::size_t index) const { return parts_.first + static_cast<Part>(index); }

    NumberRule rule_;
    PartRange parts_;
    PartRange own_numbers_;
    std::vector<std::vector<Wish>> wishes_;  ///< of each part
    std::vector<bool> was_refused_;          ///< each part, in the last round
    std::vector<Part> numbers_;              ///< of each part
    std::vector<bool> is_used_;              ///< each of own_numbers_
};

/// Answers each record that came to this rank by itself.
void answer_all(Butterfly& butterfly);

}  // namespace rrcb
