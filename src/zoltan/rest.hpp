#pragma once

#include "kept.hpp"
#include "objects.hpp"
#include "parameters.hpp"

#include <rrcb/balance.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb::zoltan {

/// What the last partition found. It stands while the objects are where they were sent and weigh
/// what they did: a program that goes on while anything changes then comes to an end.
struct Rest {
    Report report;
    int dimension = 0;
    std::vector<std::uint64_t> checksums;  ///< of the objects of each part
};

/// Adds a number for each object of this rank, made of its weights, to that of its part; the same
/// whatever the order. Not collective.
void add_checksums(const Parameters& parameters, const Workspace& workspace,
                   std::span<const Part> parts, std::span<std::uint64_t> checksums);

/// Whether every object of this rank is in the part that the last partition gave it, and the parts
/// of this rank hold what they got. Never where the parts of the objects are not known: without a
/// callback that names them only one part on each rank tells. Not collective.
bool is_at_rest(const Rest& rest, const Kept& kept, const Parameters& parameters,
                const Workspace& workspace, const Objects& objects, int rank);

}  // namespace rrcb::zoltan
