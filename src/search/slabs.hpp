#pragma once

#include "cuts/tree.hpp"
#include "search/target_rule.hpp"

#include <rrcb/method/bisection.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace rrcb {

/// Interval along the axis of a cut within which the cut is corrected: lower <= cut <= upper. The
/// ends are equal if the cut is kept.
struct Slab {
    static constexpr std::size_t stays = ~std::size_t{0};

    double lower = 0;
    double upper = 0;
    std::size_t number = stays;   ///< position in the list of all cuts that move, in preorder
    std::size_t first_count = 0;  ///< position in the counts of all slabs, see bin_in

    bool moves() const { return number != stays; }
};

/// Lengths that slabs need in a message.
struct SlabTotals {
    std::size_t moving = 0;  ///< cuts that move
    std::size_t counts = 0;  ///< in bins of their slabs
};

/// Returns upper bounds for slabs of all cuts at or below a node.
SlabTotals most_slabs(const Descent& top);

/// Lays slabs of all cuts, into `slabs` (length of the tree), by the counted weights of the parts
/// and the weight that brackets expect about the cuts.
///
/// A slab holds three times the missing weight of its cut, plus the weight that cuts above may move
/// into it. No cut moves if the slabs would hold half of all weight: a search is better then. Does
/// not allocate.
SlabTotals lay_slabs(const TargetRule& rule, const Cuts& cuts, std::span<const Bracket> brackets,
                     std::span<const double> part_weights, std::span<Slab> slabs);

/// Bins on either side of a cut in its slab, numbered from the end of the slab. They get narrower
/// towards the cut, two for each halving of the distance: how far the cut has to move is unknown.
inline constexpr int bins_a_side = 16;

/// Returns the bin of a position across the axis, in the slab, on this side of the cut.
inline int bin_of(const Slab& slab, double cut, bool above, double position) {
    const double share =
        above ? (position - cut) / (slab.upper - cut) : (cut - position) / (cut - slab.lower);
    // The exponent and the first digit of the share form a number that decreases by one from bin to
    // bin.
    constexpr int first_digit = std::numeric_limits<double>::digits - 2;
    const auto number = static_cast<int>(std::bit_cast<std::uint64_t>(share) >> first_digit);
    constexpr auto outermost = static_cast<int>(std::bit_cast<std::uint64_t>(0.75) >> first_digit);
    return std::clamp(outermost - number, 0, bins_a_side - 1);
}

/// Returns the place of a cut that has passed this share (0 ... 1) of a bin.
double place_in_bin(const Slab& slab, double cut, bool above, int bin, double share);

/// Returns the counts of a bin: one weight for each part below the cut, by which the part changes
/// if the cut passes the bin.
///
/// The parts on the bin's side of the cut lose the weight of their points in the bin. Those on the
/// other side gain it: each gets the points that cuts further down would assign to it.
template <class Count>
std::span<Count> bin_in(std::span<Count> counts, const Descent& at, const Slab& slab, bool above,
                        int bin) {
    const std::size_t k = bin + (above ? bins_a_side : 0);
    return counts.subspan(slab.first_count + k * at.num_parts, at.num_parts);
}

/// Writes the corrected places of all cuts that move into `values`, in the order of their slabs.
///
/// `part_weights` and `counts` are those of all ranks by the current cuts; `part_weights` becomes
/// the expected weights. Cuts are corrected from the root of the tree down. Each moves the weights
/// in its bins between the parts below. Points in several slabs, and positions within a bin, are
/// unknown, so a second, smaller correction may be needed. Does not allocate.
void correct(const TargetRule& rule, const Cuts& cuts, std::span<const Slab> slabs,
             std::span<double> part_weights, std::span<const double> counts,
             std::span<double> values);

}  // namespace rrcb
