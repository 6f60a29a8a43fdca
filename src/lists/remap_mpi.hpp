#pragma once

#include "collective/butterfly_mpi.hpp"
#include "cuts/number_search.hpp"

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

/// Returns the number of points of this rank that numbers keep at their origin; of `numbers` that
/// are empty, those of the parts themselves.
GlobalCount num_kept(std::span<const Part> parts, std::span<const Part> numbers,
                     const PreviousParts& previous, const NumberRule& rule, int rank);

/// More parts keep their numbers, which limits the memory and the time of rank 0.
inline constexpr int most_renumbered = 1 << 17;

/// Memory of one renumbering, allocated before the ranks agree.
struct RemapBuffers {
    /// Not collective. Throws std::bad_alloc.
    RemapBuffers(const NumberRule& rule, int rank);

    NumberRule rule;
    Butterfly told;
    ButterflyMessages messages;
    std::vector<Part> numbers;          ///< of all parts
    std::vector<GlobalCount> decision;  ///< numbers and sums that rank 0 sends
};

/// Renumbers as the public functions do, from checked arguments.
///
/// Ranks without points may lack `previous`. Collective: one pass to rank 0 and one broadcast.
/// Throws on all ranks a failure on one, also from before the call.
Remap find_numbers(std::span<const Part> parts, const PreviousParts& previous,
                   RemapBuffers& buffers, Participant& self);

/// Renumbers as the public functions do. Collective.
Remap remap(std::span<const Part> parts, const PreviousParts& previous,
            std::span<const RankRange> ranks_of_parts, const TreeShape& shape, Participant& self);

}  // namespace rrcb
