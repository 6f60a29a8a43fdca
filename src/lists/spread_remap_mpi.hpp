#pragma once

#include "collective/butterfly_mpi.hpp"
#include "lists/number_search.hpp"

#include <span>
#include <vector>

namespace rrcb {

/// Rounds of offers at most; what is not placed by then goes where numbers are left.
inline constexpr int most_rounds_of_offers = 16;

/// Ranks whose overlaps remap() gathers at one of them; more search together. Tests lower it.
inline int most_ranks_of_gathered_overlaps = 64;

/// Room for one renumbering, which the ranks make before they agree.
struct SpreadRemapRoom {
    /// For parts that lie on the ranks as ranks_of_part() tells, each on one. Not collective.
    /// Throws std::bad_alloc.
    SpreadRemapRoom(int num_parts, MPI_Comm comm);

    NumberSearch search;
    Butterfly told;
    Butterfly offers;
    Butterfly left;
};

/// New numbers of parts, as far as a rank needs them.
struct SpreadRemap {
    Remap summary{};                  ///< without numbers
    std::vector<Numbered> numbers{};  ///< of parts of its points and its own, unless all stay
};

/// Renumbers as remap() does with gathered overlaps, but no rank hears of all, and no array is as
/// long as there are parts or ranks.
///
/// With Origins::parts some ranks may have `previous` parts; where none has, and with
/// Origins::ranks, points are to stay on their rank. Collective: one pass through the ranks, one
/// more by parts, and a reduction where all stay; else two for each round of offers, and at most
/// four more and another reduction. Throws on all ranks what failed on one; what fails at last is
/// told by the next pass or agreement.
SpreadRemap remap_spread(std::span<const Part> parts, Origins origins,
                         const PreviousParts& previous, SpreadRemapRoom& room,
                         ButterflyMessages& messages, Participant& self);

}  // namespace rrcb
