#pragma once

#include "collective/butterfly_mpi.hpp"
#include "lists/number_search.hpp"

#include <rrcb/options.hpp>
#include <rrcb/remap.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rrcb {

/// Returns a hash of lists, which must be the same on every rank.
std::uint64_t hash_of(std::span<const RankRange> ranks_of_parts);

/// Earlier parts of the points. If none are given, points are to be kept on their rank.
using PreviousParts = std::optional<std::span<const Part>>;

/// Origins of the points of a rank.
class Origins {
  public:
    /// `previous` must outlive it.
    Origins(const PreviousParts& previous, const NumberRule& rule, int rank)
        : previous_(previous), num_parts_(rule.num_parts), by_rank_(rule.by_rank) {
        const auto [first, end] = rule.numbers_of(by_rank_ ? rank : 0);
        if (by_rank_ && first < end) own_ = rank;
    }

    /// Returns this rank if origins are ranks and some number keeps its points, else no_origin.
    std::int32_t own() const { return own_; }

    std::int32_t of(std::size_t point) const {
        if (by_rank_ || !previous_) return own_;
        const Part part = (*previous_)[point];
        return part >= 0 && part < num_parts_ ? part : no_origin;
    }

  private:
    const PreviousParts& previous_;
    int num_parts_;
    bool by_rank_;
    std::int32_t own_ = no_origin;
};

/// Memory of one renumbering, allocated before the ranks agree.
struct RemapBuffers {
    /// Allocates memory; if `wants_all`, every rank gets the numbers of all parts, as always if
    /// rank 0 searches. Not collective. Throws std::bad_alloc.
    RemapBuffers(const NumberRule& rule, int rank, bool wants_all = true);

    NumberSearch search;
    Butterfly told;
    Butterfly offers;  ///< then what is left of parts and numbers
    ButterflyMessages messages;
    std::vector<Part> numbers;          ///< of all parts, if wanted
    std::vector<GlobalCount> decision;  ///< of rank 0, if it searches
};

/// New numbers of parts.
struct NewNumbers {
    Remap remap{};              ///< without numbers if these are unchanged
    std::vector<Part> parts{};  ///< of remap.numbers; empty: all
};

/// Renumbers as the public functions do, from checked arguments.
///
/// Each rank gets all numbers, or, unless it wants all, those of the parts of its points and of
/// those that it searched for. In that case no array is as long as there are parts or ranks. Ranks
/// without points may lack `previous`. Collective: one pass to rank 0 and one broadcast. If all
/// ranks search: one pass, two for each round of offers, up to three more and two reductions; two
/// passes and a reduction if nothing changes. Throws on all ranks a failure on one, also from
/// before the call. If all ranks search, a failure in the last pass is reported by the next pass or
/// agreement.
NewNumbers find_numbers(std::span<const Part> parts, const PreviousParts& previous,
                        RemapBuffers& buffers, Participant& self);

/// Renumbers as the public functions do; all ranks search if more than `central_parts` have parts.
/// Collective.
Remap remap(std::span<const Part> parts, const PreviousParts& previous,
            std::span<const RankRange> ranks_of_parts, const TreeShape& shape, Participant& self,
            int central_parts = Tuning{}.central_parts);

}  // namespace rrcb
