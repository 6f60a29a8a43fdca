#pragma once

#include "refinement/refinement_mpi.hpp"

namespace rrcb {

/// What the functions of the refinement share.
struct Refinement {
    Estimate& estimate;
    const Options& options;
    const BinnedPoints& binned;
    RefinementBuffers& room;
    Participant& self;
    bool is_root;
    double weight_per_size;  ///< of a part
    bool exactly = false;    ///< without slack
    SortedPoints points{};   ///< where cuts are searched
    Measured measured{};
    bool told_of_failure = false;  ///< of another rank; at the root only
    bool abandoned = false;        ///< the root told all to stop

    std::span<const double> sizes_of(const Descent& at) const {
        return std::span(options.part_sizes)
            .subspan(static_cast<std::size_t>(at.first_part),
                     static_cast<std::size_t>(at.num_parts));
    }
    std::size_t num_parts() const { return options.part_sizes.size(); }
};

/// True when counting finds the cut of a node: when it divides weight among parts on both sides.
bool needs_search(const Node& node, const Refinement& context);

/// Begins a search for every node of the current level that needs one. Not collective.
void start_level(Refinement& context);

/// Searches all cuts of the level at once, in at most 16 rounds, see decide_by_bins.
///
/// Collective. Each round takes a reduction and a broadcast, and where searches end in gathering
/// their candidates a gather: 65,536 points at most, of all searches together.
void search_level(Refinement& context);

}  // namespace rrcb
