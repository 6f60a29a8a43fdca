#pragma once

#include "lists/remap_mpi.hpp"

#include <optional>
#include <span>
#include <vector>

namespace rrcb {

/// Memory of one renumbering, with the parts of a group in one group, see NumberRule.
struct GroupBuffers {
    /// As RemapBuffers. Not collective. Throws std::bad_alloc.
    GroupBuffers(const NumberRule& rule, int rank);

    RemapBuffers parts;
    std::optional<RemapBuffers> groups;  ///< if there are any
    std::vector<Part> numbers;           ///< of all parts, in that case
};

/// Renumbers the groups, and then the parts of each, as find_numbers() of parts does. Collective as
/// that; with groups twice, and one reduction.
Remap find_numbers(std::span<const Part> parts, const PreviousParts& previous,
                   GroupBuffers& buffers, Participant& self);

}  // namespace rrcb
