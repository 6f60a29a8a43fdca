#pragma once

#include "collective/participant.hpp"

#include <rrcb/cuts.hpp>

#include <span>

namespace rrcb {

/// All cuts of a tree, once in the memory of each machine, for all ranks that run on it.
class NodeCuts {
  public:
    NodeCuts() = default;
    /// Collective.
    ~NodeCuts();
    NodeCuts(const NodeCuts&) = delete;
    NodeCuts& operator=(const NodeCuts&) = delete;

    /// Makes room for the cuts between so many parts, once. Collective; throws Error on every rank
    /// alike.
    void make_room(int num_parts, Participant& self);

    /// Gathers the cuts of which each rank holds a part. Collective: one reduction between the
    /// machines. Throws Error on every rank alike where one lacks a cut that it owns.
    void gather(const Cuts& cuts, Participant& self);

    std::span<const Cut> tree() const { return tree_; }

  private:
    void wait_for_all(Participant& self) const;

    MPI_Comm node_ = MPI_COMM_NULL;     ///< the ranks on this machine
    MPI_Comm leaders_ = MPI_COMM_NULL;  ///< the first rank of each machine; null on the others
    MPI_Win window_ = MPI_WIN_NULL;
    std::span<Cut> tree_;
};

}  // namespace rrcb
