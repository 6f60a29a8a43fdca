#pragma once

#include "collective/butterfly.hpp"
#include "cuts/owned_cuts.hpp"
#include "lists/remap_mpi.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Rule for where points stay, of parts that lie on the ranks as ranks_of_part() tells, each on
/// one.
struct NumberRule {
    int num_parts = 1;
    int num_ranks = 1;
    Origins origins = Origins::ranks;

    /// That a rank tells, the largest ones.
    std::size_t most_overlaps() const {
        return overlaps_per_part * static_cast<std::size_t>((num_parts - 1) / num_ranks + 1);
    }

    int rank_of(Part part) const { return ranks_of_part(part, num_parts, num_ranks).first_rank; }

    /// Origin of which the points of a part stay if it keeps its number.
    std::int32_t home_of(Part part) const {
        return origins == Origins::ranks ? rank_of(part) : part;
    }
};

/// A part and its number, or the origin whose number it gets.
using Numbered = std::pair<Part, std::int32_t>;

/// Search by all ranks for numbers of the parts, so that many points stay: one rank's part in it,
/// without the messages.
///
/// Each origin takes the parts of its largest overlaps until its numbers are used up, the largest
/// of all origins first, and the parts left keep their number where they can: what
/// numbers_by_rank(), and best_numbers() of many parts, find at one place. Overlaps have one order,
/// so there is one way only to place parts such that no part and origin both have less than what
/// they could have together. Rounds of offers find it (D. Gale and L. S. Shapley: College
/// admissions and the stability of marriage, 1962). For each of its numbers the rank of an origin
/// makes an offer to the rank of a part, the largest first; this keeps the largest of each part;
/// who is refused makes the next, and asks which others would be refused as well. Offers that are
/// kept are repeated in each round, so that larger ones can take their place. However many rounds
/// there were, each number is used once at most.
///
/// What is then left of parts and of numbers is counted through by rank, and meets by its count.
///
/// Memory and messages follow from the parts that the points of a rank are in, 16 overlaps for
/// each part of the rank at most, and from its own parts. Not collective. What adds to a butterfly
/// or takes from it throws std::bad_alloc.
class NumberSearch {
  public:
    /// Throws std::bad_alloc.
    NumberSearch(int num_parts, int num_ranks, int rank);

    const NumberRule& rule() const { return rule_; }

    /// Begins with the overlaps of this rank's origins, one of a pair.
    void start(Origins origins, std::span<const Overlap> overlaps);

    /// What this rank offers that it has not offered before.
    enum class News {
        none,
        at_home,    ///< all of its offers keep the numbers of parts
        elsewhere,  ///< some would change one
    };

    /// Adds the offers of this rank, and its questions, to be joined by keep_larger().
    News offer(Butterfly& offers);

    /// Keeps the largest offer for each part of this rank, and answers with it.
    void choose(Butterfly& offers);

    /// Takes back the offers that were refused, and drops those that would be.
    void follow(const Butterfly& offers);

    /// Parts, and numbers of origins, of one rank or more.
    struct Counts {
        std::int64_t parts = 0;
        std::int64_t numbers = 0;
    };

    /// Lets parts of this rank keep their numbers where these are left; then returns what is left.
    Counts settle();

    /// Adds what is left here, where that is `before` on the ranks before this one, to be joined by
    /// unite(). Returns whether there is any.
    bool meet(const Counts& before, Butterfly& left) const;

    /// Takes the parts that numbers left here met, once answer_all() has answered.
    void take(const Counts& before, const Butterfly& left);

    /// Points that stay by the overlaps of this rank's origins, under the old numbers and the new.
    struct Kept {
        GlobalCount before = 0;
        GlobalCount after = 0;
    };
    Kept kept() const;

    /// Tells ranks the numbers of their parts, and asks for those of `parts`; to be joined by
    /// unite().
    void tell(std::span<const Part> parts, Butterfly& numbers) const;

    /// Takes the numbers of this rank's parts, and answers those who ask.
    void conclude(Butterfly& numbers);

    /// New numbers of the parts that were asked for, and of those of this rank; ascending.
    std::vector<Numbered> result(const Butterfly& numbers) const;

    static void keep_larger(std::span<const double> a, std::span<const double> b,
                            std::vector<double>& joined);
    static void unite(std::span<const double> a, std::span<const double> b,
                      std::vector<double>& joined);

  private:
    /// Offers of one origin, the largest first.
    struct Origin {
        std::size_t next;  ///< first one that was not made
        std::size_t end;
        int num_free;      ///< numbers without an offer
        bool was_refused;  ///< in the last round
    };

    bool make_offers();
    void list_numbers_left();
    std::vector<Numbered> new_numbers() const;
    std::size_t index_of(Part own) const { return static_cast<std::size_t>(own - own_.first); }

    NumberRule rule_;
    int rank_;
    PartRange own_;
    std::vector<Overlap> overlaps_;  ///< as origins have them
    std::vector<bool> is_lost_;      ///< of each: a larger offer was made
    std::vector<Origin> origins_;
    std::map<Part, std::size_t> offers_;      ///< that stand: numbers of overlaps by part
    std::vector<std::int32_t> origins_of_;    ///< that own parts go to
    std::vector<Numbered> placed_;            ///< parts that go to origins of this rank
    std::vector<Part> left_;                  ///< own parts without an origin
    std::vector<std::int32_t> numbers_left_;  ///< origin of each
    std::vector<Part> numbers_;               ///< new ones of own parts
};

/// Answers each record that came to this rank by itself.
void answer_all(Butterfly& butterfly);

}  // namespace rrcb
