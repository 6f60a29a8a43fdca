#pragma once

#include "lists/remap_mpi.hpp"

#include <optional>
#include <span>
#include <vector>

namespace rrcb {

/// Memory of one renumbering that keeps the parts of a group together, see NumberRule.
struct GroupBuffers {
    /// Allocates as RemapBuffers. Not collective. Throws std::bad_alloc.
    GroupBuffers(const NumberRule& rule, int rank);

    RemapBuffers parts;
    std::optional<RemapBuffers> groups;  ///< empty if there are no groups
    std::vector<Part> numbers;           ///< numbers of all parts, if there are groups
};

/// Renumbers the groups, and then the parts within each, in the way of find_numbers() for parts.
/// Collective as that function; with groups its messages are sent twice, and one reduction is
/// added.
Remap find_numbers(std::span<const Part> parts, const PreviousParts& previous,
                   GroupBuffers& buffers, Participant& self);

}  // namespace rrcb
