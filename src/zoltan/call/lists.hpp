#pragma once

#include "zoltan/call/objects.hpp"
#include "zoltan/handle/part_map.hpp"

#include <cstddef>
#include <span>
#include <utility>

namespace rrcb::zoltan {

/// Both of Zoltan's lists.
struct Lists {
    List imports;
    List exports;
};

/// The caller's variables for one of the two lists; `parts` may be null.
struct CallerList {
    int* count;
    ZOLTAN_ID_PTR* global_ids;
    ZOLTAN_ID_PTR* local_ids;
    int** ranks;
    int** parts;
};

/// The caller's variables.
struct CallerLists {
    int* changes;
    int* num_gid_entries;
    int* num_lid_entries;
    CallerList imports;
    CallerList exports;
};

/// The moving objects of this rank: those whose rank or part changes. As in Zoltan, without a
/// callback for parts the part of an object is the number of its rank.
class Moves {
  public:
    /// Finds the moving objects, if `objects` has memory for their indices. Borrows all arguments.
    /// Never throws.
    Moves(Objects& objects, std::span<const Part> parts, const PartMap& map, int my_rank);

    int count() const { return count_; }

    /// Writes the moving objects to `list`, in the order of the objects. `list` must have memory
    /// for all of them. It may be the memory of the objects' own ids, because each id is read
    /// before it is overwritten. Never throws.
    void write(const IdWidths& widths, List& list) const;

    /// Lists all objects with their new ranks and parts, in the memory of their ids.
    List list_all() const;

    /// Moves the memory of the ids out.
    List take_room() const { return std::move(objects_.room); }

  private:
    /// Calls visit(rank_of); rank_of(index) returns the rank of an object, and can be inlined in
    /// loops.
    template <class Visit>
    auto visit_ranks(Visit&& visit) const;
    template <class Widths, class RankOf>
    void write_by(const Widths& widths, const RankOf& rank_of, List& list) const;

    Objects& objects_;
    std::span<const Part> parts_;
    const PartMap& map_;
    int my_rank_;
    int count_ = 0;
};

/// Lists all objects of this rank with their present parts, in the memory of their ids.
List list_in_place(Objects&& objects, int my_rank);

}  // namespace rrcb::zoltan
