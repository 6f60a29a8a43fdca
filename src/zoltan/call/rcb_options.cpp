#include "zoltan/call/rcb_options.hpp"

#include "bisection/domain_kinds.hpp"
#include "cuts/cut_limits.hpp"
#include "cuts/tree.hpp"
#include "zoltan/call/forwarding.hpp"
#include "zoltan/real/zoltan_error.hpp"

#include <array>

namespace rrcb::zoltan {

namespace {

/// Axes in the order of RCB_SET_DIRECTIONS, 1 ... 6. Other values count as 1, as in Zoltan.
std::vector<int> axis_order(int set_directions, int dimension) {
    constexpr std::array<std::array<int, 3>, 6> orders = {
        {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}}};
    const bool known = set_directions >= 1 && set_directions <= 6;
    std::vector<int> axes;
    for (const int axis : orders[known ? static_cast<std::size_t>(set_directions - 1) : 0]) {
        if (axis < dimension) axes.push_back(axis);
    }
    return axes;
}

}  // namespace

void check_parameters(const State& state, bool one_part_per_rank) {
    const Parameters& parameters = state.parameters;
    if (parameters.return_lists == ReturnLists::candidates) {
        throw ZoltanError(ZOLTAN_FATAL, "RRCB makes no candidate lists; change RETURN_LISTS");
    }
    if (are_cuts_limited(parameters.options) && forwards(parameters))
        throw ZoltanError(ZOLTAN_FATAL,
                          "RRCB_MIN_WIDTH and RRCB_GRID hold along the axes of the coordinates and "
                          "for one weight; unset REDUCE_DIMENSIONS and OBJ_WEIGHT_DIM above 1");
    const int global = asked_global_parts(state);
    const int local = parameters.num_local_parts;
    const bool other_global = global != -1 && global != state.communicator->size();
    if (one_part_per_rank && (other_global || (local != -1 && local != 1))) {
        throw ZoltanError(ZOLTAN_FATAL,
                          "Zoltan_LB_Balance makes one part per rank; use Zoltan_LB_Partition for "
                          "other NUM_GLOBAL_PARTS or NUM_LOCAL_PARTS");
    }
}

Options make_options(const Parameters& parameters, const Layout& layout, int dimension,
                     const KeptPartition* previous) {
    Options options = parameters.options;
    options.num_parts = layout.map.num_parts;
    options.part_sizes = layout.part_sizes;
    options.plain_cuts = parameters.rectilinear_blocks != 0;
    // Handles that keep cuts gather them, once for a machine where there are many.
    options.cuts = HeldCuts::own;
    if (parameters.lock_directions != 0 && previous != nullptr) {
        options.cut_axes = axes_of(previous->tree());
    } else if (parameters.set_directions != 0) {
        options.grouped_axes = axis_order(parameters.set_directions, dimension);
    }
    return options;
}

bool starts_from_previous(const Parameters& parameters) {
    const Options& options = parameters.options;
    const bool refines = options.refine != Refine::none &&
                         traits_of(options.domain).builds_on_last &&
                         options.cut_rule == CutRule::weighted_fraction;
    return reuses_cuts(parameters) && refines;
}

bool keeps_cuts(const Parameters& parameters) {
    const bool asked_to_reuse = parameters.reuse_cuts != not_set && parameters.reuse_cuts != 0;
    return parameters.keep_cuts != 0 || asked_to_reuse || parameters.lock_directions != 0;
}

bool chooses_axes(std::string_view name) {
    return name == "RCB_SET_DIRECTIONS" || name == "RCB_RECTILINEAR_BLOCKS";
}

std::vector<std::string> parameter_warnings(const Parameters& parameters) {
    std::vector<std::string> texts;
    if (parameters.set_directions < 0 || parameters.set_directions > 6) {
        texts.emplace_back("Parameter RCB_SET_DIRECTIONS out of bounds; reset to 1.");
    }
    return texts;
}

}  // namespace rrcb::zoltan
