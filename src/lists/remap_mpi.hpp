#pragma once

#include "collective/butterfly_mpi.hpp"
#include "cuts/number_search.hpp"

#include <rrcb/remap.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rrcb {

/// Returns a hash of the lists, which must be equal on all ranks.
std::uint64_t hash_of(std::span<const RankRange> ranks_of_parts);

/// Earlier parts of the points. Without a value, points should remain on their rank.
using PreviousParts = std::optional<std::span<const Part>>;

/// The origin of each point of a rank: its earlier part, or the rank.
class Origins {
  public:
    /// `previous` must outlive it.
    Origins(const PreviousParts& previous, const NumberRule& rule, int rank)
        : previous_(previous), num_parts_(rule.num_parts), by_rank_(rule.by_rank) {
        const auto [first, end] = rule.numbers_of(by_rank_ ? rank : 0);
        if (by_rank_ && first < end) own_ = rank;
    }

    /// Returns this rank if origins are ranks and this rank has a number to keep its points;
    /// otherwise no_origin.
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

/// Returns how many points of this rank remain at their origin with the given numbers of parts. If
/// `numbers` is empty, each part has its own number.
GlobalCount num_kept(std::span<const Part> parts, std::span<const Part> numbers,
                     const PreviousParts& previous, const NumberRule& rule, int rank);

/// Parts are not renumbered if there are more of them, which limits the memory and time of rank 0.
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

/// Renumbers as the public functions do; the arguments must have been checked.
///
/// Ranks without points may come without `previous`. Collective: one pass to rank 0 and one
/// broadcast. If a rank has failed, before or here, all ranks throw its error.
Remap find_numbers(std::span<const Part> parts, const PreviousParts& previous,
                   RemapBuffers& buffers, Participant& self);

/// Renumbers as the public functions do. Collective.
Remap remap(std::span<const Part> parts, const PreviousParts& previous,
            std::span<const RankRange> ranks_of_parts, const TreeShape& shape, Participant& self);

}  // namespace rrcb
