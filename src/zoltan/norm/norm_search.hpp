#pragma once

#include "zoltan/norm/multicriteria.hpp"

#include <rrcb/cuts.hpp>

#include <cstdint>
#include <limits>
#include <span>

namespace rrcb::zoltan {

/// Whole number that orders as a double does. Both zeros have one.
std::int64_t key_of(double value);

/// Smallest and largest key of some coordinates, in a form that a maximum reduces.
struct KeyRange {
    std::int64_t complement_of_smallest = std::numeric_limits<std::int64_t>::min();
    std::int64_t largest = std::numeric_limits<std::int64_t>::min();

    void add(std::int64_t key);
};

/// Division of a range of coordinates into slots that ascend with them. Its ends lie in different
/// ones.
struct Bins {
    bool by_value = false;  ///< even in value, otherwise in the order of the bits
    double half_lower = 0;
    double per_half = 0;  ///< slots per half a unit of value
    std::int64_t lower_key = 0;
    int shift = 0;
    int count = 0;

    int slot_of(double value) const;
};

/// Search for the cut across one axis where the norms of the two sides meet.
///
/// All ranks take the same steps, by sums over all of them. A step takes in the range of the
/// objects left and divides it into slots. It counts the loads of the slots, and leaves the objects
/// of one. The search ends at a single coordinate. It goes on along the other axes among the
/// objects that share it.
class NormSearch {
  public:
    /// `num_axes`: number of axes that may break ties, its own included. `aim` has objects.
    NormSearch(int axis, int num_axes, const Aim& aim);

    bool is_done() const { return done_; }
    int axis() const { return cut_.axis; }

    /// The axis along which the objects left are looked at.
    int current_axis() const;

    /// Takes in the range of the objects left, where it is unknown. Returns whether slots are to be
    /// counted next.
    bool narrow(const KeyRange& range);

    /// Slots for the next count; `most` is a power of 2, at least 2.
    Bins bins(int most) const;

    /// Takes in the load of each slot. Returns the slot whose objects are left.
    int choose(std::span<const Load> slots);

    /// Extent of all objects along the axis of the cut, halved so that it is finite.
    double half_extent() const { return half_extent_; }

    // Once done:
    const Cut& cut() const { return cut_; }
    const Load& below() const { return below_; }
    double quality() const { return zoltan::quality(aim_, below_); }

    /// Whether the norms meet among objects that share a place, so that no cut divides them. The
    /// load `before` lies below all of them.
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

/// Whether the next of the objects in one place goes below. `below` is the load below without it.
bool goes_below(const Aim& aim, const Load& below, const Load& object);

}  // namespace rrcb::zoltan
