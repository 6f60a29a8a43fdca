#pragma once

#include "collective/participant.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/experimental/join_keys.hpp>
#include <rrcb/experimental/verify.hpp>
#include <rrcb/ghosts.hpp>
#include <rrcb/groups.hpp>
#include <rrcb/quality.hpp>
#include <rrcb/transfer.hpp>

#include <span>
#include <vector>

// The public functions of the same names call these functions on the duplicated communicator. All
// are collective. If a rank has failed before, all ranks throw its error.

namespace rrcb {

/// Gives every rank the complete tree. Before, each cut is on one rank, and is zero on the others.
/// Holds errors back.
void join_cuts(std::span<Cut> tree, Participant& self);

std::vector<Part> assign(const Cuts& cuts, const Points& points, Participant& self);

Plan plan(std::span<const Part> parts, int num_parts, Participant& self);

/// As transfer(), for columns without their types.
void move(const Plan& plan, std::span<const detail::ByteColumn> columns,
          const TransferOptions& options, Participant& self);

/// As transfer_in_place(), for columns without their types.
void move_in_place(const Plan& plan, std::span<const detail::ByteColumn> columns,
                   Participant& self);

GhostPlan ghost_plan(const Cuts& cuts, const Points& points, const GhostOptions& options,
                     Participant& self);
// These return true if all messages of the same columns fit into the limits, each as one piece.
bool move(const GhostPlan& plan, std::span<const detail::ByteColumn> columns,
          const TransferOptions& options, Participant& self);
bool move_back(const GhostPlan& plan, std::span<const detail::ByteColumn> of_ghosts,
               std::span<const detail::ByteColumn> of_points, const TransferOptions& options,
               Participant& self);
void move(const detail::Replies& replies, std::span<const detail::ByteColumn> columns,
          const TransferOptions& options, Participant& self);

Groups groups(const Points& points, std::span<const std::uint64_t> keys, GroupPlace place,
              Participant& self);
void move(const Groups& groups, std::span<const detail::ByteColumn> columns,
          const TransferOptions& options, Participant& self);
std::vector<double> group_sums(const Groups& groups, std::span<const double> values,
                               std::size_t components, Participant& self);

std::vector<double> part_weights(const Points& points, std::span<const Part> parts, int num_parts,
                                 Participant& self);
double moved_fraction(const Points& points, std::span<const Part> parts, int num_parts,
                      Participant& self);

namespace experimental {

Verification verify(const GhostPlan& plan, const Points& points, const VerifyOptions& options,
                    Participant& self);
std::vector<std::uint64_t> join_keys(std::span<const std::uint64_t> keys,
                                     std::size_t keys_per_point, Participant& self);

}  // namespace experimental

}  // namespace rrcb
