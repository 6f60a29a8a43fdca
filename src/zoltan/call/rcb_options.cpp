#include "zoltan/call/rcb_options.hpp"

#include "cuts/cut_limits.hpp"
#include "cuts/tree.hpp"
#include "options/call_kind.hpp"
#include "zoltan/real/message.hpp"

#include <array>
#include <atomic>
#include <cstdio>

namespace rrcb::zoltan {

namespace {

/// Returns the order of axes that RCB_SET_DIRECTIONS (1 to 6) stands for. Other values count as 1,
/// as in Zoltan.
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

/// Returns the setting because of which the call is left to Zoltan's RCB; null if there is none.
const char* forwarded_setting(const Parameters& parameters) {
    if (parameters.weight_dimension > 1) return "OBJ_WEIGHT_DIM is above 1";
    if (parameters.reduce_dimensions != 0) return "REDUCE_DIMENSIONS is set";
    // If RRCB's own parameters limit the positions of cuts, AVERAGE_CUTS has no meaning.
    if (parameters.average_cuts != 0 && !are_cuts_limited(parameters.options))
        return "AVERAGE_CUTS is set";
    return nullptr;
}

}  // namespace

bool forwards(const Parameters& parameters) {
    return forwarded_setting(parameters) != nullptr;
}

void print_forwarding(const State& state, const char* function) noexcept {
    static std::atomic<bool> is_printed = false;
    if (state.communicator->rank() != 0 || state.parameters.debug_level <= 0) return;
    if (is_printed.exchange(true)) return;
    std::array<char, 128> text{};
    std::snprintf(text.data(), text.size(), "Zoltan's RCB answers this call and its look-ups: %s",
                  forwarded_setting(state.parameters));
    print_warning(0, function, text.data());
}

void check_parameters(const State& state, bool one_part_per_rank) {
    const Parameters& parameters = state.parameters;
    if (parameters.return_lists == ReturnLists::candidates)
        throw_fatal("RRCB makes no candidate lists; change RETURN_LISTS");
    if (are_cuts_limited(parameters.options) && forwards(parameters))
        throw_fatal(
            "RRCB_MIN_WIDTH and RRCB_GRID hold along the axes of the coordinates and "
            "for one weight; unset REDUCE_DIMENSIONS and OBJ_WEIGHT_DIM above 1");
    if (parameters.paper_domain && are_cuts_limited(parameters.options))
        throw_fatal(
            "RRCB_MIN_WIDTH and RRCB_GRID need RRCB_DOMAIN=ANALYTIC; set it, or unset "
            "both limits");
    const int global = asked_global_parts(state);
    const int local = parameters.num_local_parts;
    const bool other_global = global != -1 && global != state.communicator->size();
    if (one_part_per_rank && (other_global || (local != -1 && local != 1)))
        throw_fatal(
            "Zoltan_LB_Balance makes one part per rank; use Zoltan_LB_Partition for "
            "other NUM_GLOBAL_PARTS or NUM_LOCAL_PARTS");
}

Options make_options(const Parameters& parameters, const Layout& layout, int dimension,
                     const LastPartition* previous) {
    Options options = parameters.options;
    options.num_parts = layout.map.num_parts;
    options.part_sizes = layout.part_sizes;
    options.expert.axes.plain = parameters.rectilinear_blocks != 0;
    // The parts of a machine have consecutive numbers only if each rank has the same number of
    // parts.
    const PartMap& map = layout.map;
    const bool are_alike = map.is_even && map.num_parts % map.num_ranks == 0;
    if (!map.one_each && !are_alike) options.expert.tree.group_size = 1;
    if (parameters.lock_directions != 0 && previous != nullptr) {
        options.expert.tree = previous->cuts().shape;
        options.expert.axes.order = AxisOrder::given(axes_of(previous->cuts().tree));
    } else if (parameters.set_directions != 0) {
        options.expert.axes.order =
            AxisOrder::grouped(axis_order(parameters.set_directions, dimension));
    }
    return options;
}

PaperOptions make_paper_options(const Parameters& parameters, const Layout& layout) {
    PaperOptions options;
    options.num_parts = layout.map.num_parts;
    options.part_sizes = layout.part_sizes;
    options.domain = *parameters.paper_domain;
    options.cut_rule = parameters.cut_rule;
    options.plain_cuts = parameters.rectilinear_blocks != 0;
    if (parameters.options.expert.cells_per_axis != 0)
        options.cells_per_axis = parameters.options.expert.cells_per_axis;
    options.sigma_multiplier = parameters.sigma_multiplier;
    options.sample_fraction = parameters.sample_fraction;
    options.seed = parameters.seed;
    return options;
}

bool starts_from_previous(const Parameters& parameters) {
    const bool refines = !parameters.paper_domain && parameters.options.refine != Refine::none;
    return reuses_cuts(parameters) && refines;
}

bool keeps_cuts(const Parameters& parameters) {
    const bool asked_to_reuse = parameters.reuse_cuts != not_set && parameters.reuse_cuts != 0;
    return parameters.keep_cuts != 0 || asked_to_reuse || parameters.lock_directions != 0;
}

bool chooses_axes(std::string_view name) {
    return name == "RCB_SET_DIRECTIONS" || name == "RCB_RECTILINEAR_BLOCKS" ||
           name == "RRCB_MACHINES";
}

std::vector<std::string> parameter_warnings(const Parameters& parameters) {
    std::vector<std::string> texts;
    if (parameters.set_directions < 0 || parameters.set_directions > 6) {
        texts.emplace_back("Parameter RCB_SET_DIRECTIONS out of bounds; reset to 1.");
    }
    const auto ignore_if = [&](bool is_set, const char* name) {
        if (is_set)
            texts.push_back(std::string("Parameter ") + name + " has no effect with RRCB_DOMAIN=" +
                            (parameters.paper_domain ? "SAMPLED and POINTS" : "ANALYTIC") + '.');
    };
    if (!parameters.paper_domain) {
        ignore_if(parameters.cut_rule != Parameters{}.cut_rule, cut_rule_parameter.parameter);
        return texts;
    }
    ignore_if(parameters.set_directions != 0, "RCB_SET_DIRECTIONS");
    ignore_if(parameters.lock_directions != 0, "RCB_LOCK_DIRECTIONS");
    ignore_if(parameters.reuse_cuts != not_set && parameters.reuse_cuts != 0, "RCB_REUSE");
    ignore_if(parameters.options.refine == Refine::exact, "RRCB_REFINE");
    return texts;
}

}  // namespace rrcb::zoltan
