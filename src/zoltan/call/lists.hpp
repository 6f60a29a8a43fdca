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

/// The moving objects of this rank: their rank or part changes. Without a callback for parts an
/// object is in the part of its rank's number, as in Zoltan.
class Moves {
  public:
    /// Finds these objects if `objects` has room for their indices. Borrows all. Never throws.
    Moves(Objects& objects, std::span<const Part> parts, const PartMap& map, int my_rank);

    int count() const { return count_; }

    /// Writes the moving objects to `list` in their order. `list` has room for all of them. It may
    /// be the room of the objects' own ids, since each is read before it is overwritten. Never
    /// throws.
    void write(const IdWidths& widths, List& list) const;

    /// Lists all objects with their new ranks and parts, in the room of their ids.
    List list_all() const;

    /// Takes the room of the ids.
    List take_room() const { return std::move(objects_.room); }

  private:
    /// Calls visit(rank_of) with a function of the index of an object, which loops can inline.
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

/// Lists all objects of this rank with their present parts, in the room of their ids.
List list_in_place(Objects&& objects, int my_rank);

}  // namespace rrcb::zoltan
