#pragma once

#include "zoltan/norm/multicriteria.hpp"

#include <rrcb/cuts.hpp>

#include <cstdint>
#include <limits>
#include <span>

namespace rrcb::zoltan {

/// A double as a whole number that is ordered alike; both zeros are one.
std::int64_t key_of(double value);

/// Smallest and largest key of some coordinates, in a form of which the largest counts.
struct KeyRange {
    std::int64_t complement_of_smallest = std::numeric_limits<std::int64_t>::min();
    std::int64_t largest = std::numeric_limits<std::int64_t>::min();

    void add(std::int64_t key);
};

/// Divides a range of coordinates into slots that ascend with them; the ends lie in different ones.
struct Bins {
    bool by_value = false;  ///< even in value, otherwise in the order of the bits
    double half_lower = 0;
    double per_half = 0;  ///< slots per half a unit of value
    std::int64_t lower_key = 0;
    int shift = 0;
    int count = 0;

    int slot_of(double value) const;
};

/// The search for the cut across one axis where the norms of the two sides meet.
///
/// Every rank goes through the same steps, by what all ranks hold together: the range of the
/// objects left, then their loads in slots of it, of which one is left, until a coordinate is
/// found; then the same along the other axes among the objects that share it.
class NormSearch {
  public:
    /// `num_axes`: how many may break ties, its own included. `aim` has objects.
    NormSearch(int axis, int num_axes, const Aim& aim);

    bool is_done() const { return done_; }
    int axis() const { return cut_.axis; }

    /// The axis along which the objects left are looked at.
    int current_axis() const;

    /// Takes in the range of the objects left, where it is not known. True when slots are to be
    /// counted next.
    bool narrow(const KeyRange& range);

    /// Slots for the next count; `most` is a power of 2, at least 2.
    Bins bins(int most) const;

    /// Takes in the load of each slot; returns the one whose objects are left.
    int choose(std::span<const Load> slots);

    /// Of all objects, along the axis of the cut, halved so that it is finite.
    double half_extent() const { return half_extent_; }

    // Once done:
    const Cut& cut() const { return cut_; }
    const Load& below() const { return below_; }
    double quality() const { return zoltan::quality(aim_, below_); }

    /// Whether the norms meet among objects that share a place, so that no cut divides them;
    /// `before` lies below all of them.
    bool meets_one_place() const { return one_place_; }
    const Load& before() const { return base_; }
    const Aim& aim() const { return aim_; }

  private:
    void finish(bool one_place);

    Aim aim_;
    Cut cut_;
    int num_axes_;
    int tied_ = 0;    ///< axes along which the objects left do not differ
    int rounds_ = 0;  ///< of counting along the current axis
    bool done_ = false;
    bool one_place_ = false;
    double half_extent_ = -1;
    std::int64_t lower_ = 0;
    std::int64_t upper_ = 0;
    Load base_{};  ///< below the objects left
    Load left_{};
    Load below_{};
};

/// Whether the next of the objects in one place, in their order, goes below: `below` is what lies
/// below without it.
bool goes_below(const Aim& aim, const Load& below, const Load& object);

}  // namespace rrcb::zoltan
