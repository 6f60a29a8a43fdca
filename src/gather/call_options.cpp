#include "gather/call_options.hpp"

#include "arithmetic/part_share.hpp"
#include "cuts/cut_limits.hpp"
#include "gather/contribution.hpp"
#include "gather/decision_mpi.hpp"
#include "options/validation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

namespace rrcb {

namespace {

/// Largest number of regions that rank 0 makes. With more, rank 0 would receive more than a rank
/// that owns nodes.
constexpr int most_regions = 64;

constexpr std::size_t most_cells_of_regions = 112;

void append_region_nodes(const Descent& at, int num_regions, std::vector<Descent>& nodes) {
    if (num_regions == 1) return nodes.push_back(at);
    append_region_nodes(at.lower(), num_regions / 2, nodes);
    append_region_nodes(at.upper(), num_regions / 2, nodes);
}

/// Appends the axes of the cuts between regions.
void append_axes(const Descent& at, int num_regions, std::span<const int> cut_axes,
                 std::vector<int>& axes) {
    if (num_regions == 1) return;
    axes.push_back(cut_axes[at.node]);
    append_axes(at.lower(), num_regions / 2, cut_axes, axes);
    append_axes(at.upper(), num_regions / 2, cut_axes, axes);
}

/// Returns the number of levels below `at`, up to `most`, on which no node is a part.
int full_levels(const Descent& at, int most) {
    if (most == 0 || at.is_part()) return 0;
    return 1 + std::min(full_levels(at.lower(), most - 1), full_levels(at.upper(), most - 1));
}

/// Returns the options of regions: as many as the lowest full level up to central_parts and
/// most_regions has nodes, with a tolerance that leaves the levels below their share. For exact
/// cuts there is one region; with more, rank 0 would gather points about each cut, and a number
/// from each rank.
Options region_options(const Options& parts) {
    const auto most = static_cast<unsigned>(std::min(parts.tuning.central_parts, most_regions));
    const bool is_exact = parts.refine == Refine::exact;
    const Descent top = root_of(parts.num_parts, parts.tree);
    Options regions = parts;
    regions.tree = {};
    regions.num_parts = is_exact ? 1 : 1 << full_levels(top, std::bit_width(most) - 1);
    if (regions.num_parts == 1) regions.refine = Refine::none;
    regions.part_sizes.clear();
    for (const Descent& at : region_nodes(parts, regions.num_parts)) {
        const std::span sizes(parts.part_sizes);
        regions.part_sizes.push_back(
            sizes.empty() ? at.num_parts : sum_of(sizes.subspan(at.first_part, at.num_parts)));
    }
    normalize(regions.part_sizes, regions.num_parts);
    if (const AxisOrder& order = parts.axes.order; order.is_given()) {
        std::vector<int> axes;
        append_axes(top, regions.num_parts, order.axes(), axes);
        regions.axes.order = AxisOrder::given(std::move(axes));
    }
    const double levels = num_levels(regions.tree, regions.num_parts);
    regions.imbalance_tolerance =
        std::pow(parts.imbalance_tolerance, levels / num_levels(parts.tree, parts.num_parts));
    return regions;
}

}  // namespace

bool is_spread(const Options& options, int num_ranks) {
    return std::min(options.num_parts, num_ranks) > options.tuning.central_parts &&
           is_refined(options) && !options.axes.order.is_grouped() && !are_cuts_limited(options);
}

CallOptions call_options(Options options, int num_ranks) {
    CallOptions call{std::move(options)};
    const bool spread = is_spread(call.parts, num_ranks);
    if (!spread || !call.parts.part_sizes.empty())
        normalize(call.parts.part_sizes, call.parts.num_parts);
    if (spread) call.regions = region_options(call.parts);
    return call;
}

std::size_t most_merged_cells(const CallOptions& options) {
    const std::size_t most = most_cells(options.parts);
    return options.is_spread() ? std::min(most, most_cells_of_regions) : most;
}

std::vector<Descent> region_nodes(const Options& parts, int num_regions) {
    std::vector<Descent> nodes;
    append_region_nodes(root_of(parts.num_parts, parts.tree), num_regions, nodes);
    return nodes;
}

}  // namespace rrcb
